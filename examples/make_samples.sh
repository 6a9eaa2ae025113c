#!/usr/bin/env bash
# Makes the embedded samples anew, byte for byte, with the given oriel-generate.
#   examples/make_samples.sh GENERATOR          writes examples/samples
#   examples/make_samples.sh --check GENERATOR  compares instead; ends with 1 if a file differs
set -euo pipefail

usage() { sed -n '2,4s/^# \{0,1\}//p' "$0" >&2; exit 2; }

samples=$(cd "$(dirname "$0")" && pwd)/samples
check=no
if [ "${1-}" = --check ]; then
  check=yes
  shift
fi
[ $# -eq 1 ] || usage
generator=$1
folder=$samples
if [ "$check" = yes ]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi

make() { "$generator" -o "$folder" --name "$@"; }

house=(--seed 2266 --roof gable --storeys 2 --width 10.5..12.5 --depth 8..9
       --features window,door,chimney,dormer,balcony,canopy,stairs,sill,overhang)
make house "${house[@]}"
make house-flush "${house[@]}" --flush 1
make house-noisy "${house[@]}" --noise 1
make house-utm "${house[@]}" --triangulate --rotate 17 --origin 604000,5403766,370
make hip --seed 7 --roof hip --storeys 2 --width 10..12 --depth 8..9.5 \
  --features window,door,chimney,dormer,overhang,panes,bay,plinth,garage
make block --seed 2 --roof flat --storeys 4 --width 13..16 --depth 9..10 \
  --features window,door,loggia,vent,parapet,strip,cornice
make l-house --seed 1 --roof gable --storeys 2 --width 13..15 --depth 8..9 \
  --features window,door,wing,chimney,roof_window,shutter,gable_window,french_window
make row --seed 2 --roof gable --storeys 2 --width 24 --depth 8 \
  --features window,door,bay,chimney,plinth,vent,canopy,sill

# The building of the paper's figure 5, by a script of its own.
if command -v python3 >/dev/null; then
  python3 "$samples/../figure5.py" >"$folder/figure5.city.json"
elif [ "$check" = yes ]; then
  echo "figure5.city.json is not compared: no python3"
  cp "$samples/figure5.city.json" "$folder"
fi

# The house of `oriel rules new`, without truth and labels.
starter=$samples/../../rules/starter/my_class.city.json
made=$(mktemp -d)
trap 'rm -rf "$made"; [ "$check" = no ] || rm -rf "$folder"' EXIT
"$generator" -o "$made" --roof gable --storeys 1 --width 9 --depth 7 --features window,door,chimney \
  --add "my_class panel on roof1 at 1,1 size 1.7x1x0.06" --add "my_class panel on roof1 at 3,1 size 1.7x1x0.06"
[ "$check" = yes ] || cp "$made/house.stripped.city.json" "$starter"

if [ "$check" = yes ]; then
  diff -q "$starter" "$made/house.stripped.city.json"
  diff -rq "$samples" "$folder"
fi
