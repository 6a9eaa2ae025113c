# shellcheck shell=bash disable=SC2034,SC2154
# Sourced by the scripts that label what has truth, results.sh and by_rule.sh: the data sets, each as `DO NAME TRUTH INPUT…`.
# Needs $work, a folder to write to; data sets of ../shared (or $ORIEL_SHARED) are left out where it is absent.
shared=${ORIEL_SHARED:-../shared}
generate=build/release/examples/generator/oriel-generate

# Buildings of others.
# for_each_foreign_set DO
for_each_foreign_set() {
  local set
  for set in random3dcity ingolstadt ogc-simple-house houses/clean houses/noisy houses/triangles delft-blocks; do
    if [ -d "$shared/data/$set" ]; then
      "$1" "$set" "$shared/data/$set" "$shared/data/$set"/*.stripped.city.json
    fi
  done
}

# Houses of our own generator: stdin has a line for each set, its name and options.
# for_each_generated_set DO [SUFFIX OF NAMES]
for_each_generated_set() {
  local name options
  while read -r name options; do
    # shellcheck disable=SC2086
    "$generate" --seed 77 --count 100 $options -o "$work/$name.city.jsonl" --truth "$work/$name.truth.jsonl"
    "$1" "generated: $name${2-}" "$work/$name.truth.jsonl" "$work/$name.city.jsonl" </dev/null
  done
}

generated_sets='plain
jitter --jitter 0.3
noisy --noise 0.5
noisy-1 --noise 1
noisy-1-triangulated --noise 1 --triangulate
triangulated --triangulate
turned --rotate 27 --origin 604000,5403766,370
half-flush --flush 0.5
english --style english'
# With the setting for noise of 5 mm (docs/solidify.md).
noisy_sets='noisy-5 --noise 5
noisy-5-triangulated --noise 5 --triangulate'
noisy_options=(--plane-offset 0.008)
