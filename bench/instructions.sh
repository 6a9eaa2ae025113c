#!/usr/bin/env bash
# Instructions of one call of segment() (both orders) and of solidify(), counted by callgrind, for generated buildings of
# 20, 100, 500 and 2000 windows, regular and jittered; millions. Reading the file is not counted. `growth` is the exponent
# between 100 and 2000 windows: 1 is linear. The same on every run of one build.
set -euo pipefail
cd "$(dirname "$0")/.."
examples/install_packages.sh
if ! command -v valgrind >/dev/null; then
  root=()
  if [ "$(id -u)" -ne 0 ]; then root=(sudo); fi
  "${root[@]}" apt-get install -y -qq --no-install-recommends valgrind >/dev/null
fi
cmake --preset release -DORIEL_BENCH=ON >/dev/null
cmake --build --preset release --target bench_counted_call oriel-generate >&2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# count FILE STAGE [ORDER]: instructions of one call.
count() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=counted_call \
    build/release/bench/bench_counted_call "$2" "$1" "${@:3}" 2>&1 >/dev/null | awk '$2 == "Collected" { print $4 }'
}

printf '%-17s%-10s%11s%11s%11s%11s%9s\n' call windows 20 100 500 2000 growth
for call in 'segment natural' 'segment paper' solidify; do
  for shape in 'regular 0' 'jittered 0.3'; do
    read -r name jitter <<<"$shape"
    counts=()
    for windows in 20 100 500 2000; do
      file=$work/$name-$windows.stripped.city.json
      [ -f "$file" ] || build/release/examples/generator/oriel-generate --seed 3 --roof gable --windows "$windows" \
        --jitter "$jitter" --name "$name-$windows" -o "$work"
      # shellcheck disable=SC2086
      counts+=("$(count "$file" $call)")
    done
    printf '%s\n' "${counts[@]}" | awk -v call="$call" -v name="$name" '
      { n[NR] = $1 }
      END { printf "%-17s%-10s%11.2f%11.2f%11.1f%11.1f%9.2f\n", call, name, n[1] / 1e6, n[2] / 1e6, n[3] / 1e6, n[4] / 1e6,
                   log(n[4] / n[2]) / log(20) }'
  done
done
