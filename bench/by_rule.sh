#!/usr/bin/env bash
# Labels every data set and prints how well each rule does, `score --by-rule`: what it decided, how much of that is right, what
# the wrong ones are, and the first mistakes of each rule. Last the sum over the buildings of others, a line a rule. Needs a release
# build; data sets of ../shared (or $ORIEL_SHARED) are left out where it is absent.
#   bench/by_rule.sh [WORD]    with a WORD only the sets whose names have it
set -euo pipefail
cd "$(dirname "$0")/.."
oriel=build/release/cli/oriel
word=${1-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# shellcheck source=bench/sets.sh
source bench/sets.sh

label_options=()
sum=

# by_rule NAME TRUTH INPUT…; with $sum the figures are also put into that folder.
by_rule() {
  local name=$1 truth=$2
  shift 2
  case $name in *"$word"*) ;; *) return 0 ;; esac
  echo "== $name"
  "$oriel" label "${label_options[@]}" "$@" --features "$work/parts.jsonl" 2>"$work/messages" || [ $? -eq 3 ]
  "$oriel" score "$work/parts.jsonl" --truth "$truth" --by-rule --rules residential | sed -n '/^rule /,$p'
  if [ -n "$sum" ]; then
    "$oriel" score "$work/parts.jsonl" --truth "$truth" --by-rule --rules residential --json >"$sum/${name//\//-}.json"
  fi
}

mkdir "$work/foreign"
sum=$work/foreign
for_each_foreign_set by_rule
sum=
for_each_generated_set by_rule <<<"$generated_sets"
label_options=("${noisy_options[@]}")
for_each_generated_set by_rule ", ${label_options[*]}" <<<"$noisy_sets"

# Of some sets there is no sum over all.
[ -z "$word" ] && compgen -G "$work/foreign/*.json" >/dev/null || exit 0
echo "== all buildings of others"
python3 - "$work"/foreign/*.json <<'PYTHON'
import json
import sys

rules = {}
for name in sys.argv[1:]:
    with open(name, encoding="utf-8") as file:
        for rule, counts in json.load(file)["rules"].items():
            whole = rules.setdefault(rule, {"label": counts["label"], "decided": 0, "right": 0, "wrong": 0, "left_out": 0})
            for count in ("decided", "right", "wrong", "left_out"):
                whole[count] += counts[count]
line = "{:<22}  {:<8}  {:>8}  {:>8}  {:>6}  {:>9}  {:>9}"
print(line.format("rule", "label", "decided", "right", "wrong", "left out", "precision"))
for rule, c in sorted(rules.items()):
    judged = c["right"] + c["wrong"]
    precision = f"{c['right'] / judged:.3f}" if judged else "-"
    print(line.format(rule, c["label"], c["decided"], c["right"], c["wrong"], c["left_out"], precision))
PYTHON
