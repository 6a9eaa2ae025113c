#!/usr/bin/env bash
# Makes the pictures of docs/tiles.md anew: the page of 60 generated houses from far to near. Needs Chromium, Node and the packages of
# tests/tiles/run.sh. Usage: docs/tiles.sh [ORIEL [ORIEL_GENERATE [FOLDER OF PACKAGES]]]
set -euo pipefail
cd "$(dirname "$0")/.."
oriel=$(realpath "${1:-build/release/cli/oriel}")
generate=$(realpath "${2:-build/release/examples/generator/oriel-generate}")
packages=$(realpath "${3:-build/release/tests/tiles_judges}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$generate" --count 60 -o "$work/town.city.jsonl" 2>/dev/null
node tests/tiles/town.mjs "$work/town.city.jsonl"
"$oriel" tiles "$work/town.city.jsonl" -o "$work/town" --crs local --viewer --outlines --scales 1:100,1:500,1:1000,1:5000,1:25000
ORIEL_PIXELS=6 ORIEL_PICTURES=docs ORIEL_SIZE=480x360 node tests/tiles/view.mjs "$packages" "$(command -v chromium)" "$work/town" 60
