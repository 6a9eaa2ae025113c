#!/usr/bin/env bash
# Makes tilesets and puts them before gltf-validator, 3d-tiles-tools and a browser (README.md). Without node, npm or Chromium, or where
# the packages cannot be had, it says `skipped` (exit code 77).
#   tests/tiles/run.sh [--install] [--full] [--pictures FOLDER] [ORIEL [ORIEL_GENERATE [FOLDER FOR PACKAGES]]]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../browser_tools.sh"
root=$(realpath "$here/../..")
is_full=false
while [ $# -gt 0 ]; do
  case $1 in
    --install) install_missing ;;
    --full) is_full=true ;;
    --pictures) ORIEL_PICTURES=$(realpath -m "$2"); export ORIEL_PICTURES; shift ;;
    *) break ;;
  esac
  shift
done
oriel=$(realpath "${1:-$root/build/release/cli/oriel}")
generate=$(realpath "${2:-$root/build/release/examples/generator/oriel-generate}")
packages=$(realpath -m "${3:-$root/build/release/tests/tiles_judges}")
need_programs
need_packages "$here" "$packages" 180
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tiles() { # NAME INPUT OPTIONS: a tileset; what it says is shown only if it fails
  local name=$1 input=$2
  shift 2
  "$oriel" tiles "$input" -o "$work/$name" -j 0 --progress none --allow-bad 100% "$@" 2>"$work/$name.log" || { cat "$work/$name.log"; exit 1; }
}
houses=60
"$generate" --count $houses -o "$work/houses.city.jsonl" 2>/dev/null
node "$here/town.mjs" "$work/houses.city.jsonl"
tiles houses "$work/houses.city.jsonl" --scales 1:100,1:500,1:1000,1:5000,1:25000 --viewer --outlines --crs local --gzip --compress meshopt
"$generate" --count 6 -o "$work/few.city.jsonl" 2>/dev/null
tiles packed "$work/few.city.jsonl" --outlines --crs EPSG:25832 --compress meshopt
folders=("$work/packed")
# Small houses by default, for time.
sizes=(--storeys 1 --width 6..8)
if $is_full; then sizes=(); fi
"$generate" --count 500 "${sizes[@]}" -o "$work/many.city.jsonl" 2>/dev/null
tiles many "$work/many.city.jsonl" --crs EPSG:25832
folders+=("$work/many")
tile="${ORIEL_SHARED:-$root/../shared}/data/3dbag/tile_5910.city.jsonl"
if [ -e "$tile" ]; then
  # Of the few buildings that would take most of the time, fewer features are found.
  budget=(--budget 4000000)
  if $is_full; then budget=(); fi
  tiles city "$tile" "${budget[@]}" --most-triangles 2000 --colours surface
  folders+=("$work/city")
else
  echo "skipped: the tile of 3DBAG, as there is no $tile"
fi
node "$here/judge.mjs" "$packages" "${folders[@]}"
ORIEL_PIXELS=${ORIEL_PIXELS:-0.2} node "$here/view.mjs" "$packages" "$(command -v chromium)" "$work/houses" "$houses"
