#!/usr/bin/env bash
# Makes the figures of docs/generalisation.md anew: the examples of the paper, each as labelled and as generalised.
# The commands are those of the page. Usage: docs/generalisation.sh [ORIEL]
set -euo pipefail
cd "$(dirname "$0")/.."
oriel=${1:-build/release/cli/oriel}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# NAME SAMPLE SCALE
draw() {
  "$oriel" view "examples/samples/$2.stripped.city.json" --rules cartographic --scales "$3" --azimuth 148 --size 1000,480 -o "docs/generalisation-$1.png" 2>"$work/log"
}

draw aggregated block 1:2000
draw enlarged l-house 1:2500
draw removed house 1:2500
draw typified row 1:4000

# A block and the street before it at four scales: sixteen houses of a generated city.
"$(dirname "$oriel")/../examples/generator/oriel-generate" --style city --count 32 --seed 5 -o "$work/town.city.jsonl"
sed -i 2,17d "$work/town.city.jsonl"
cat > "$work/town.yaml" <<'PROFILE'
schema: oriel-profile/1
profile: {name: town, version: 1.0.0}
levels:
  map: {form: as-is, map-mm: 0.3, verdicts: {point: omit, line: omit, small: omit}, buildings: {aggregate: touching, gap-mm: 0.2}}
PROFILE
drawn=()
for scale in 1:500 1:2500 1:5000 1:10000; do
  level="$work/1 to ${scale#1:}"
  "$oriel" generalise "$work/town.city.jsonl" --neighbours --rules cartographic --profile "$work/town.yaml" --scale "$scale" -o "$level.city.jsonl" 2>>"$work/log"
  drawn+=(--after "$level.city.jsonl")
done
"$oriel" view "${drawn[1]}" "${drawn[@]:2}" --azimuth 148 --size 1200,900 -o docs/generalisation-street.png 2>>"$work/log"

# Ten buildings of five kinds at six scales, each beside itself as large as on a map.
for sample in house l-house hip block row; do ln -s "$PWD/examples/samples/$sample.stripped.city.json" "$work/$sample.city.json"; done
generate() { "$(dirname "$oriel")/../examples/generator/oriel-generate" "${@:2}" --name "$1" -o "$work/$1.city.jsonl" 2>>"$work/log"; }
generate terrace --style english --count 1 --seed 3
generate flats --style english --count 1 --seed 8
generate corner --style city --count 1 --seed 2
generate shed --roof shed --seed 4
generate hall --roof flat --width 40 --depth 12 --storeys 2 --seed 6
"$oriel" view "$work"/{house,l-house,hip,block,row}.city.json "$work"/{terrace,flats,corner,shed,hall}.city.jsonl --rules cartographic \
  --scales 1:500,1:1000,1:2500,1:5000,1:10000,1:25000 --at-map-size 300 --azimuth 148 --size 1680,2000 -o docs/generalisation-sheet.png 2>>"$work/log"
