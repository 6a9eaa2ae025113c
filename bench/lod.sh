#!/bin/bash
# 3DBAG LoD 2.2 to 2.0, 1.3 and 1.2, against the data's own levels: docs/results.md, "Levels of detail".
set -euo pipefail
cd "$(dirname "$0")/.."
data=${ORIEL_SHARED:-../shared}/data/3dbag/tile_5910.city.jsonl
oriel=${ORIEL:-build/release/cli/oriel}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$oriel" generalise "$data" --lod 2.2 --to-lod 2.0,1.3,1.2 -o "$work/lods.city.jsonl" 2>&1 | tail -1 || true  # two buildings are set aside
for pair in 2.0:2.2 1.3:2.2 1.3:1.3 1.2:2.2 1.2:1.2; do
  python3 bench/lod.py "$work/lods.city.jsonl" "${pair%:*}" "$data" "${pair#*:}"
done
mkdir "$work/houses"
"$oriel" generalise "${data%/3dbag*}"/random3dcity/*.stripped.city.json --to-lod 2.0,1.3,1.2,1.0 -o "$work/houses/" 2>&1 | tail -1 || true  # two buildings are set aside
python3 bench/lod_truth.py "${data%/3dbag*}/random3dcity" "$work/houses"
