#!/bin/bash
# oriel beside CGAL's edge collapse at the same number of triangles: docs/results.md, "Compared with edge collapse".
set -euo pipefail
cd "$(dirname "$0")/.."
data=${ORIEL_SHARED:-../shared}/data
bench=${BENCH:-build/release/bench/bench_collapse}
for scale in 2500 5000; do
  "$bench" "$scale" "$data"/random3dcity/*.stripped.city.json
done
"$bench" 10000 "$data"/3dbag/tile_5910.city.jsonl
