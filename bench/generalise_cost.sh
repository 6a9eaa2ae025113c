#!/usr/bin/env bash
# What `generalise` costs beside `label`: instructions of whole calls of the command on the first 12 houses of ../shared, counted by callgrind,
# in millions and as multiples of what `label` takes. The same on every run of one build.
#   bench/generalise_cost.sh [HOUSES] [ORIEL]
set -euo pipefail
cd "$(dirname "$0")/.."
data=$(realpath "${ORIEL_SHARED:-../shared}")/data
houses=${1:-12}
oriel=$(realpath "${2:-build/release/cli/oriel}")
[ -d "$data" ] || { echo "skipped: no $data"; exit 0; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mapfile -t files < <(find "$data/houses/clean" -name '*.stripped.city.json' | sort | head -n "$houses")

# count COMMAND…: instructions of one call.
count() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$oriel" "$@" -o "$work/out/" 2>&1 >/dev/null | awk '$2 == "Collected" { print $4 }'
}

label=$(count label "${files[@]}")
printf '%-14s%-14s%10s%8s\n' pack scale millions times
awk -v n="$label" 'BEGIN { printf "%-14s%-14s%10.0f%8.2f\n", "residential", "(label)", n / 1e6, 1 }'
for pack in residential cartographic; do
  for scale in 1000 2500 10000; do
    all=$(count generalise "${files[@]}" --rules "$pack" --scale "1:$scale")
    awk -v pack="$pack" -v scale="1:$scale" -v n="$all" -v one="$label" \
      'BEGIN { printf "%-14s%-14s%10.0f%8.2f\n", pack, scale, n / 1e6, n / one }'
  done
done
