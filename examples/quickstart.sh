#!/usr/bin/env bash
# From a bare Debian 12 to a labelled and generalised building: installs what is missing, builds oriel, labels the
# sample house, redraws it for two scales, and says what was found and where the files are.
set -euo pipefail
cd "$(dirname "$0")/.."

examples/install_packages.sh --build
mkdir -p build
log=build/quickstart.log
cmake --preset release -DORIEL_TESTS=OFF -DORIEL_UNITY=ON >"$log" 2>&1 || { cat "$log"; exit 1; }
echo "building oriel (some minutes the first time)"
cmake --build --preset release --target oriel 2>&1 | tee "$log" | examples/show_progress.sh || { tail -n 40 "$log"; exit 1; }

oriel=build/release/cli/oriel
house=examples/samples/house.stripped.city.json
out=build/quickstart
mkdir -p "$out"

echo
echo "== what is in $house"
"$oriel" label "$house"
echo "== how well that is"
"$oriel" label "$house" --features "$out/house.features.jsonl" -o "$out/house.labelled.city.json"
"$oriel" score "$out/house.features.jsonl" --truth examples/samples/house.truth.json
for scale in 5000 20000; do
  echo "== redrawn for 1:$scale"
  "$oriel" generalise "$house" --scale "1:$scale" -o "$out/house-1-$scale.city.json"
done
echo
echo "The files (CityJSON 2.0: look at them in QGIS, Blender with Up3date, or ninja.cityjson.org):"
ls -1 "$PWD/$out"/house*
