#!/usr/bin/env bash
# Segments the real buildings of ../shared (or $ORIEL_SHARED) one by one, in both orders: solids of buildings read, cells,
# milliseconds of processor time that a building takes (median, 99th percentile, longest; each the median of three calls, mesh in memory to
# tree, cells and features, one thread), and leaves that are not convex by their flag (docs/segmentation.md).
set -euo pipefail
cd "$(dirname "$0")/.."
data=${ORIEL_SHARED:-../shared}/data
[ -d "$data" ] || { echo "skipped: no $data"; exit 0; }
examples/install_packages.sh
cmake --preset release -DORIEL_BENCH=ON >/dev/null
cmake --build --preset release --target bench_corpus >&2
printf '%-18s%-8s  %12s%9s | %10s%10s%10s | %6s%14s%7s%8s\n' \
  data order solids cells median p99 longest own no-candidate cycle budget
while read -r name lod files; do
  # shellcheck disable=SC2086
  [ ! -d "$data/$name" ] || build/release/bench/bench_corpus "$name" "$lod" "$data/$name"/$files
done <<'SETS'
random3dcity - *.stripped.city.json
ogc-simple-house - *.stripped.city.json
ingolstadt - *.stripped.city.json
3dbag 2.2 *.city.jsonl
SETS
