#!/usr/bin/env bash
# For how many true objects some node of the tree, in the natural order, has their box (IoU 0.8 or more): random3dcity of
# ../shared (or $ORIEL_SHARED; left out where it is absent), and generated houses with chimneys across the ridge and over
# an apex. Needs python3.
set -euo pipefail
cd "$(dirname "$0")/.."
examples/install_packages.sh
cmake --preset release >/dev/null
cmake --build --preset release --target oriel oriel-generate >&2
data=${ORIEL_SHARED:-../shared}/data
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# recall NAME CLASSES TRUTH INPUT: INPUT and TRUTH may be patterns.
recall() {
  echo "$1"
  # shellcheck disable=SC2086
  build/release/cli/oriel segment $4 --features "$work/parts.jsonl" 2>"$work/messages" || [ $? -eq 3 ]
  tail -n 1 "$work/messages" | sed 's/^/  /'
  # shellcheck disable=SC2086
  python3 bench/recall.py "$work/parts.jsonl" "$2" $3
}

if [ -d "$data/random3dcity" ]; then
  recall random3dcity window,door,chimney,dormer "$data/random3dcity/*.truth.json" "$data/random3dcity/*.stripped.city.json"
else
  echo "random3dcity: skipped: no $data"
fi
while IFS=: read -r name options; do
  # shellcheck disable=SC2086
  build/release/examples/generator/oriel-generate --seed 11 --count 1000 $options -o "$work/town.city.jsonl" \
    --truth "$work/town.truth.jsonl"
  recall "generated: $name" chimney "$work/town.truth.jsonl" "$work/town.city.jsonl"
done <<'SETS'
chimneys across the ridge:--chimney ridge
chimneys over an apex:--chimney apex --roof hip
SETS
