#!/bin/bash
# What comes of every solid at every target: valid in the file, done as asked, no short edges. docs/results.md, "Yield".
set -euo pipefail
cd "$(dirname "$0")/.."
houses=${1:-1000}
data=${ORIEL_SHARED:-../shared}/data
oriel=${ORIEL:-build/release/cli/oriel}
generate=${ORIEL_GENERATE:-build/release/examples/generator/oriel-generate}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 bench/yield.py --header
for noise in 0 1 2; do  # mm
  "$generate" --seed $((noise + 1)) --count $(((houses + noise) / 3)) --noise "$noise" --name "noise-$noise" -o "$work/$noise.city.jsonl"
done
python3 bench/yield.py "$oriel" generated "$work"/[012].city.jsonl
for name in random3dcity ingolstadt ogc-simple-house; do
  python3 bench/yield.py "$oriel" "$name" "$data/$name"/*.stripped.city.json
done
for lod in 2.2 1.3 1.2; do
  python3 bench/yield.py "$oriel" "3dbag:$lod" "$data/3dbag/tile_5910.city.jsonl"
done
