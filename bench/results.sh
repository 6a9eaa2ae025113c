#!/usr/bin/env bash
# Labels every data set and scores it against its truth: the figures of docs/results.md. Needs a release build; data sets
# of ../shared (or $ORIEL_SHARED) are left out where it is absent.
set -euo pipefail
cd "$(dirname "$0")/.."
oriel=build/release/cli/oriel
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# shellcheck source=bench/sets.sh
source bench/sets.sh

# Options of label, beside the defaults.
label_options=()

# score NAME TRUTH INPUT…: set-aside buildings count as misses, so exit 3 is no failure here.
score() {
  local name=$1 truth=$2
  shift 2
  echo "== $name"
  "$oriel" label "${label_options[@]}" "$@" --features "$work/parts.jsonl" 2>"$work/messages" || [ $? -eq 3 ]
  tail -n 1 "$work/messages"
  "$oriel" score "$work/parts.jsonl" --truth "$truth" | sed -n '/^class/,/^macro/p'
}

for_each_foreign_set score
if [ -d "$shared/data/houses/clean" ]; then
  mkdir "$work/removed"
  python3 bench/remove_faces.py "$work/removed" "$shared/data/houses/clean"/*.stripped.city.json
  score "houses/clean without 5 % of the faces" "$shared/data/houses/clean" "$work/removed"/*.city.json
fi
for_each_generated_set score <<<"$generated_sets"
label_options=("${noisy_options[@]}")
for_each_generated_set score ", ${label_options[*]}" <<<"$noisy_sets"
# 500 houses of seeds that nothing was tuned on: recessed and flush openings mixed, noise of 0 to 5 mm.
files=() truths=()
seed=2718
for noise in 0 1 2 3.5 5; do
  "$generate" --seed $seed --count 100 --name "mixed$seed" --flush 0.5 --noise $noise -o "$work/mixed$seed.city.jsonl" \
    --truth "$work/mixed$seed.truth.jsonl"
  files+=("$work/mixed$seed.city.jsonl") truths+=("$work/mixed$seed.truth.jsonl")
  seed=$((seed + 1))
done
echo "== generated: 500 mixed, ${label_options[*]}"
"$oriel" label "${label_options[@]}" "${files[@]}" --features "$work/parts.jsonl" 2>"$work/messages" || [ $? -eq 3 ]
tail -n 1 "$work/messages"
"$oriel" score "$work/parts.jsonl" --truth "${truths[@]}" --models "${files[@]}" --bootstrap 1000 |
  sed -n -e '/^class/,/^macro/p' -e '/^by area/,$p'
