#!/usr/bin/env bash
# Runs the commands that work in threads under the thread sanitizer, on generated houses, some of them broken lines, and compares their
# outputs with those of one thread. Run by hand:
#   cmake --preset tsan -DORIEL_TESTS=OFF && cmake --build --preset tsan && tests/tsan.sh [HOUSES=12 [ORIEL GENERATOR]]
set -euo pipefail
cd "$(dirname "$0")/.."
build=$PWD/build/tsan suppressions=$PWD/tests/tsan.supp houses=${1:-12}
oriel=${2:-$build/cli/oriel} generator=${3:-$build/examples/generator/oriel-generate}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export TSAN_OPTIONS="suppressions=$suppressions exitcode=66"

"$generator" -o city.city.jsonl --count "$houses" --seed 3 >/dev/null
awk 'NR > 1 && NR % 7 == 5 { print substr($0, 1, 300); next } { print }' city.city.jsonl >in.city.jsonl

# compared NAME EXIT_CODE ARGUMENTS…: with -j 1 and with -j 4 the same files, and no race.
compared() {
  local name=$1 expected=$2 code=0
  shift 2
  for jobs in 1 4; do
    rm -rf out && mkdir out
    code=0
    "$oriel" "$@" -j "$jobs" 2>"$name.$jobs.log" || code=$?
    [ "$code" -eq "$expected" ] || { echo "$name -j $jobs: exit code $code"; head -60 "$name.$jobs.log"; exit 1; }
    mv out "$name.$jobs"
  done
  diff -r "$name.1" "$name.4"
  diff "$name.1.log" "$name.4.log"
  echo "$name: no race, the same bytes"
}

compared label 3 label in.city.jsonl -o out/a.city.jsonl --features out/parts.csv
compared segment 3 segment in.city.jsonl --json -o out/a.json
compared repair 3 repair in.city.jsonl -o out/a.city.jsonl --report out/report.jsonl
compared generalise 3 generalise in.city.jsonl --scale 1:5000 -o out/a.city.jsonl --explain out/why.jsonl
"$oriel" label city.city.jsonl --features parts.csv 2>/dev/null
compared interpret 0 interpret parts.csv -o out/again.csv
