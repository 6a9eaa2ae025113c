#!/usr/bin/env bash
# Runs experiments of this folder, with the buildings that they are made for: the samples, and houses in two styles that
# oriel-generate makes here, in data/, the first time.
#   examples/experiments/run.sh [--oriel ORIEL] [--generator GENERATOR] OUT [NAME…]     without names: all of them
# The results of NAME go to OUT/NAME.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
oriel=$here/../../build/release/cli/oriel
generator=$here/../../build/release/examples/generator/oriel-generate
usage() { sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 2; }
while [ $# -gt 0 ]; do
  case $1 in
    --oriel) oriel=${2-}; shift 2 ;;
    --generator) generator=${2-}; shift 2 ;;
    -*) usage ;;
    *) break ;;
  esac
done
[ $# -ge 1 ] || usage
out=$1
shift
[ $# -gt 0 ] || set -- $(cd "$here" && ls -- *.yaml | sed 's/[.]yaml$//')

data=$here/data
mkdir -p "$data"
make_houses() {
  [ -e "$data/$1.city.jsonl" ] || "$generator" --style "$1" --count 60 --seed "$2" --name "$1" -o "$data/$1.city.jsonl" --truth "$data/$1.truth.jsonl"
}
make_houses continental 41
make_houses english 42
for name in "$@"; do "$oriel" experiment run "$here/$name.yaml" -o "$out/$name"; done
