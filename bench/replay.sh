#!/bin/bash
# Series of all solids, replayed both ways: every level and every prefix of the log. docs/results.md, "Series".
set -euo pipefail
cd "$(dirname "$0")/.."
houses=${1:-1000}
data=${ORIEL_SHARED:-../shared}/data
oriel=${ORIEL:-build/release/cli/oriel}
generate=${ORIEL_GENERATE:-build/release/examples/generator/oriel-generate}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
differs=0
replay() { python3 bench/replay.py "$oriel" "$@" || differs=1; }
python3 bench/replay.py --header
for noise in 0 1 2; do  # mm
  "$generate" --seed $((noise + 1)) --count $(((houses + noise) / 3)) --noise "$noise" --name "noise-$noise" -o "$work/$noise.city.jsonl"
  replay "generated, $noise mm" "$work/$noise.city.jsonl"
done
for name in random3dcity ingolstadt ogc-simple-house; do
  replay "$name" "$data/$name"/*.stripped.city.json
done
for lod in 2.2 1.3 1.2; do
  replay "3dbag:$lod" "$data/3dbag/tile_5910.city.jsonl"
done
exit $differs
