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
