#!/usr/bin/env bash
# Makes the figures of docs/generalisation.md anew: the examples of the paper, each as labelled and as generalised.
# The commands are those of the page. Usage: docs/generalisation.sh [ORIEL]
set -euo pipefail
cd "$(dirname "$0")/.."
oriel=${1:-build/release/cli/oriel}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# NAME SAMPLE SCALE AZIMUTH_DEG
draw() {
  local sample=examples/samples/$2.stripped.city.json
  "$oriel" label "$sample" --rules cartographic -o "$work/before.city.json" 2>"$work/log"
  "$oriel" generalise "$sample" --rules cartographic --scale "$3" -o "$work/after.city.json" 2>>"$work/log"
  python3 docs/picture.py "docs/generalisation-$1.png" --azimuth "$4" "$work/before.city.json" "$work/after.city.json"
}

draw aggregated block 1:2000 32
draw enlarged l-house 1:2500 32
draw removed house 1:2500 32
draw typified row 1:4000 32

# A block and the street before it at four scales: sixteen houses of a generated city.
"$(dirname "$oriel")/../examples/generator/oriel-generate" --style city --count 32 --seed 5 -o "$work/town.city.jsonl"
sed -i 2,17d "$work/town.city.jsonl"
cat > "$work/town.yaml" <<'PROFILE'
schema: oriel-profile/1
profile: {name: town, version: 1.0.0}
levels:
  map: {form: as-is, map-mm: 0.3, verdicts: {point: omit, line: omit, small: omit}, buildings: {aggregate: touching, gap-mm: 0.2}}
PROFILE
levels=()
for scale in 1:500 1:2500 1:5000 1:10000; do
  level=$work/${scale/:/-}
  "$oriel" generalise "$work/town.city.jsonl" --neighbours --rules cartographic --profile "$work/town.yaml" --scale "$scale" -o "$level.city.jsonl" 2>>"$work/log"
  "$oriel" collect "$level.city.jsonl" -o "$level.city.json" 2>>"$work/log"
  levels+=("$level.city.json")
done
python3 docs/picture.py docs/generalisation-street.png --azimuth 32 "${levels[@]}"
