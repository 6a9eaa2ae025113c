#!/usr/bin/env bash
# Labels the buildings of every set of ../shared (or $ORIEL_SHARED) one by one, as the command does, and lists the slowest of each set:
# polygons, milliseconds of processor time (the median of three calls, reading and writing not counted), microseconds per polygon, how many
# times the set's median that is, and the stage that takes most of it. Ends with 1 if a building takes more than 100 times the median.
#   bench/slowest.sh [ROWS] [SET]     so many buildings of each set, by default one; only the sets whose names begin so
set -euo pipefail
cd "$(dirname "$0")/.."
data=${ORIEL_SHARED:-../shared}/data
rows=${1:-1}
set=${2:-}
[ -d "$data" ] || { echo "skipped: no $data"; exit 0; }
examples/install_packages.sh
cmake --preset release -DORIEL_BENCH=ON >/dev/null
cmake --build --preset release --target bench_slowest >&2
printf '%-18s%10s%10s | %9s%10s%10s%8s  %-15s  %s\n' set buildings median polygons ms per times stage building
code=0
while read -r name lod files; do
  case $name in "$set"*) ;; *) continue ;; esac
  # shellcheck disable=SC2086
  build/release/bench/bench_slowest "$name" "$lod" "$rows" "$data"/$files || code=1
done <<'SETS'
random3dcity - random3dcity/*.stripped.city.json
ingolstadt - ingolstadt/*.stripped.city.json
ogc-simple-house - ogc-simple-house/*.stripped.city.json
3dbag-2.2 2.2 3dbag/*.city.jsonl
3dbag-1.3 1.3 3dbag/*.city.jsonl
houses-clean - houses/clean/*.stripped.city.json
houses-noisy - houses/noisy/*.stripped.city.json
houses-triangles - houses/triangles/*.stripped.city.json
delft-blocks - delft-blocks/*.stripped.city.json
delfshaven - delfshaven/*.city.json
faults - faults/*.json faults/*.jsonl faults/*.obj
SETS
exit "$code"
