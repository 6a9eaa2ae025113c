#!/usr/bin/env bash
# Bytes sent to view a whole city at each scale: docs/results.md. The bytes of the edge collapse are those of the leaves by the share of
# triangles that it leaves. Needs node and the packages of tests/tiles/run.sh.
#   bench/tiles.sh [HOUSES [ORIEL [ORIEL_GENERATE [FOLDER OF PACKAGES]]]]
set -euo pipefail
cd "$(dirname "$0")/.."
houses=${1:-200}
oriel=$(realpath "${2:-build/release/cli/oriel}")
generate=$(realpath "${3:-build/release/examples/generator/oriel-generate}")
packages=$(realpath "${4:-build/release/tests/tiles_judges}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$generate" --count "$houses" -o "$work/town.city.jsonl" 2>/dev/null
node tests/tiles/town.mjs "$work/town.city.jsonl"
"$oriel" tiles "$work/town.city.jsonl" -o "$work/town" --crs local --scales 1:500,1:1000,1:2500,1:5000,1:10000,1:25000 2>/dev/null
node bench/tiles.mjs "$packages" "$work/town"
