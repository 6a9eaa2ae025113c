#!/usr/bin/env bash
# Writes what all commands put out over the samples and ../shared (or $ORIEL_SHARED): stdout, stderr, exit codes and files, each
# run in a folder of its own, and the hashes of all of them. Made before and after a change, `diff BEFORE/hashes AFTER/hashes`
# says what the change did to users.
#   bench/outputs.sh [--keep] PROGRAM FOLDER [WORD]
# PROGRAM as built, absolute or relative; with a WORD only runs whose names have it. Without --keep only the hashes stay.
set -euo pipefail
keep=
if [ "${1:-}" = --keep ]; then keep=yes; shift; fi
program=$(realpath "$1")
[ -x "$program" ] || { echo "no program at $1" >&2; exit 2; }
mkdir -p "$2"
out=$(realpath "$2")
word=${3:-}
root=$(realpath "$(dirname "$0")/..")
data=$(realpath "${ORIEL_SHARED:-$root/../shared}/data")
samples=$root/examples/samples
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Paths of this machine leave no trace in what is compared.
ln -s "$data" "$work/data"
ln -s "$samples" "$work/samples"
ln -s "$root/rules" "$work/rules"
ln -s "$root/examples/first_pack.yaml" "$work/first_pack.yaml"
ln -s "$root/tests/data" "$work/tests"
cd "$work"

# run NAME ARGUMENTS…: what it writes beside stdout and stderr goes into @, the folder of the run.
run() {
  local name=$1 code=0
  shift
  case $name in *"$word"*) ;; *) return 0 ;; esac
  rm -rf "${out:?}/$name"
  mkdir -p "$out/$name"
  rm -f here
  ln -s "$out/$name" here
  timeout 600 "$program" "${@//@/here}" >"$out/$name/stdout" 2>"$out/$name/stderr" </dev/null || code=$?
  echo "$code" >"$out/$name/exit"
  # The program itself, hashes with its own, its memory and where the folder is are no output.
  sed -i -E '/"(program_sha256|run_sha256|peak_memory_bytes)"/d' "$out/$name"/*.status.json 2>/dev/null || true
  sed -i "s#$out/##g" "$out/$name/stderr"
}

scales="1:500 1:1000 1:2500 1:5000 1:10000 1:25000"
formats="citygml2 citygml3 gpkg obj off ply stl glb"

# all NAME FILES…: every command over these files, every scale and every format.
all() {
  local name=$1
  shift
  run "$name-segment" segment "$@" --json --faces
  run "$name-segment-paper" segment "$@" --order paper --json
  run "$name-label" label "$@" -o @/ --features @/parts.jsonl --status @/status
  run "$name-label-table" label "$@" --features @/parts.csv
  run "$name-label-why" label "$@" -o @/ --explain --ignore-semantics
  run "$name-validate" validate "$@" --json
  run "$name-repair" repair "$@" -o @/ --report @/report.jsonl
  for scale in $scales; do
    run "$name-${scale/:/-}" generalise "$@" --scale "$scale" -o @/ --explain @/why.txt --metrics @/metrics.jsonl
  done
  run "$name-cartographic" generalise "$@" --scale 1:2500 --rules cartographic -o @/ --explain @/why.txt
  run "$name-lod" generalise "$@" --to-lod 2.0,1.2 -o @/ --explain @/why.jsonl
  run "$name-lod-low" generalise "$@" --to-lod 1.3,1.0 -o @/
  run "$name-series" generalise "$@" --series 1:1000,1:2500,1:10000 -o @/all
  run "$name-tiles" tiles "$@" --crs local -o @/tiles
  run "$name-cat" cat "$@" -o @/
  for format in $formats; do run "$name-$format" label "$@" --to "$format" -o @/; done
}

all samples samples/*.stripped.city.json
for set in random3dcity ingolstadt ogc-simple-house delft-blocks; do all "$set" "data/$set"/*.stripped.city.json; done
for set in houses houses-b houses-c; do
  for kind in clean noisy triangles; do all "$set-$kind" "data/$set/$kind"/*.stripped.city.json; done
done
all 3dbag data/3dbag/tile_5910.city.jsonl --random 4
run 3dbag-label label data/3dbag/tile_5910.city.jsonl -o @/out.city.jsonl --features @/parts.jsonl
all delfshaven data/delfshaven/delfshaven.city.json --random 8
run delfshaven-label label data/delfshaven/delfshaven.city.json -o @/out.city.json --features @/parts.jsonl
run delfshaven-close repair data/delfshaven/delfshaven.city.json --random 4 -o @/out.city.json --close any
for file in data/cases/*/*.{city.json,city.jsonl,gml,obj,off,stl}; do
  name=cases-$(basename "$(dirname "$file")")-$(basename "$file")
  run "$name-label" label "$file" -o @/ --features @/parts.csv
  run "$name-validate" validate "$file" --json
  run "$name-scale" generalise "$file" --scale 1:5000 -o @/
done
for file in crash-conformance-file.city.json crash-ground-facet.city.jsonl e901-balanced-tree.city.jsonl e901-doubled-solid.city.jsonl \
  hang-insets-real.city.jsonl hang-insets.city.jsonl mini_level.city.json mini_threshold.city.json ub-collect-overflow.city.jsonl; do
  run "faults-$file" label "data/faults/$file" -o "@/$file" --features @/parts.csv
done

house=samples/house.stripped.city.json
run house-segment segment "$house"
run house-tree segment "$house" --tree
run house-label label "$house"
run house-label-first label "$house" --rules first_pack.yaml
run house-label-obj label "$house" -o @/house.obj --features @/parts.json
run house-label-stl label "$house" -o @/house.stl
run house-label-citygml2 label "$house" -o @/house.gml
run house-label-citygml3 label "$house" --to citygml3 --closed-installations -o @/house.gml
run house-label-gpkg label "$house" -o @/house.gpkg
run house-label-off label "$house" -o @/house.off
run house-label-replace label samples/house.labelled.city.json --existing replace -o @/house.city.json
run house-label-audit label samples/house.labelled.city.json --existing audit
run house-repaired label samples/house-noisy.stripped.city.json --repaired -o @/house.city.json
run house-isolate label samples/*.stripped.city.json --isolate -j 2 --features @/parts.csv
run house-explain explain "$house" f2hgk
run house-explain-full explain "$house" f2hgk --full
run house-explain-building explain "$house"
run house-explain-json explain "$house" f11yv --json
run house-explain-surface explain "$house" --surface 3
run house-explain-at explain "$house" --at 0.1,2.2,5
run house-view view "$house" -o @/house.html
for format in png svg pdf; do run "house-view-$format" view "$house" -o "@/house.$format" --scale-bar; done
run house-view-scales view "$house" --scales 1:1000,1:2500,1:5000 --facade south --dark -o @/scales.svg
run house-cfd generalise "$house" --profile cfd -o @/house.stl
run house-cfd-obj generalise "$house" --profile cfd -o @/house.obj
for profile in plateau:2.1 map lod:2.0 citygml:2; do
  run "house-${profile%:*}" generalise "$house" --scale 1:10000 --profile "$profile" -o @/house.city.json --explain @/why.txt
done
run house-cartographic generalise "$house" --scale 1:2500 --rules cartographic -o @/house.city.json --explain @/why.txt
run house-series generalise "$house" --series 1:500,1:2000,1:10000 -o @/house
run block-series generalise samples/block.stripped.city.json --series 1:1000,1:5000 --rules cartographic -o @/block
[ ! -e "$out/house-series" ] || run house-series-at generalise --at 1:3000 --from "$out/house-series/house" -o @/house.city.json
run 3dbag-series generalise data/3dbag/tile_5910.city.jsonl --random 16 --series 1:1000,1:10000 -o @/tile
[ ! -e "$out/random3dcity-label" ] || {
  run score score "$out/random3dcity-label/parts.jsonl" --truth data/random3dcity --bootstrap 100 --per-building @/buildings.csv --curve @/curve.csv
  run score-json score "$out/ingolstadt-label/parts.jsonl" --truth data/ingolstadt --json
  run score-area score "$out/samples-label/parts.jsonl" --truth samples --models samples/*.stripped.city.json
  run interpret interpret "$out/random3dcity-label/parts.jsonl" -o @/again.jsonl
  run interpret-first interpret "$out/samples-label/parts.jsonl" --rules first_pack.yaml
  run diff diff "$out/samples-label/parts.jsonl" "$out/houses-noisy-label/parts.jsonl" --json
}
run score-surfaces score --surfaces samples/*.labelled.city.json
run split split data/3dbag/tile_5910.city.jsonl --count 100 -o @/tile
run collect collect "$out/split/tile/"*.city.jsonl -o @/all.city.json
for pack in residential cartographic; do
  run "rules-check-$pack" rules check "$pack"
  run "rules-test-$pack" rules test "rules/$pack.yaml"
  run "rules-fmt-$pack" rules fmt "rules/$pack.yaml"
  run "rules-show-$pack" rules show "$pack" --merged
done
run rules-schema rules schema
for pack in tests/rules/*.yaml; do run "wrong-$(basename "$pack" .yaml)" rules check "$pack" --json; done
for file in tests/errors/*; do run "bad-$(basename "$file")" label "$file" --features @/parts.csv; done
run help --help
for command in cat collect split merge segment label generalise repair explain view interpret diff score validate; do
  run "help-$command" "$command" --help
done

(cd "$out" && find . -type f ! -path ./hashes -print0 | sort -z | xargs -0 sha256sum) >"$work/hashes"
mv "$work/hashes" "$out/hashes"
[ -n "$keep" ] || find "$out" -mindepth 1 -maxdepth 1 -type d -exec rm -r {} +
