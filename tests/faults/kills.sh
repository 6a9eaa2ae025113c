#!/usr/bin/env bash
# Kills `oriel label`, `generalise`, `generalise --series` and `merge` at random moments (kill -9), gives the same command again until it
# comes to its end, and compares every output with that of a run that nobody disturbed. label and generalise go on where they were
# (--resume); a series and a merge begin again. No temporary file
# may be left when all came to its end.
#   kills.sh ORIEL GENERATOR [KILLS=1000] [SEED=1] [HOUSES=16]
set -euo pipefail
oriel=$(realpath "$1") generator=$(realpath "$2") kills=${3:-1000} RANDOM=${4:-1} houses=${5:-16}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

"$generator" -o city.city.jsonl --count "$houses" --seed 7 >/dev/null
# Bad records, too: one line in twenty is cut off.
awk 'NR > 1 && NR % 20 == 5 { print substr($0, 1, 300); next } { print }' city.city.jsonl >in.city.jsonl
head -n 5 city.city.jsonl >few.city.jsonl
"$generator" -o long.city.jsonl --count 1500 --seed 8 >/dev/null
"$oriel" split long.city.jsonl --count 100 -o long 2>/dev/null

# One run: what is written stands in the folder `out`, which is the same path for every run.
label=("$oriel" label in.city.jsonl -o out/label.city.jsonl --features out/parts.csv --status out/label --resume)
redraw=("$oriel" generalise in.city.jsonl --scale 1:5000 -o out/small.city.jsonl --explain out/why.jsonl --status out/small --resume)
series=("$oriel" generalise few.city.jsonl --series 1:500,1:5000 -o out/house)
merge=("$oriel" merge long/*.city.jsonl --split long/split.json -o out/merged.city.jsonl)
names=(label redraw series merge)

now() { date +%s%N; }
# label and generalise reject the bad records: exit code 3.
run_to_end() { local code=0; "$@" 2>>log || code=$?; [ "$code" -eq 0 ] || [ "$code" -eq 3 ]; }
# Peak memory is what a run may differ in.
books() { sed -i '/peak_memory_bytes/d' out/*.status.json; }
leftovers() { find out -name '*.tmp-*' -o -name '*.partial' -o -name '*.journal*' -o -name '*.new'; }

declare -A took_ns killed resumed
mkdir out
for name in "${names[@]}"; do
  declare -n line=$name
  begin=$(now)
  run_to_end "${line[@]}" || { echo "the undisturbed $name fails"; tail log; exit 1; }
  took_ns[$name]=$(($(now) - begin)) killed[$name]=0
done
books
mv out undisturbed
: >log

all=0 rounds=0
while [ "$all" -lt "$kills" ]; do
  rm -rf out && mkdir out
  rounds=$((rounds + 1))
  for name in "${names[@]}"; do
    declare -n line=$name
    jobs=(); [ "$name" = merge ] || jobs=(-j $((RANDOM % 2 + 1)))
    for attempt in 1 2 3 4; do
      [ "$all" -lt "$kills" ] || break
      "${line[@]}" "${jobs[@]}" 2>>log &
      process=$!
      wait_ns=$((${took_ns[$name]} / 1000 * (RANDOM % 1000)))
      sleep "$((wait_ns / 1000000000)).$(printf %09d $((wait_ns % 1000000000)))"
      # How long a run takes depends on what else the machine does.
      if kill -9 "$process" 2>/dev/null; then
        killed[$name]=$((${killed[$name]} + 1)) all=$((all + 1)) took_ns[$name]=$((${took_ns[$name]} / 20 * 21))
      else
        took_ns[$name]=$((${took_ns[$name]} / 10 * 8))
      fi
      wait "$process" 2>/dev/null || true
      for final in out/*.city.jsonl out/*.csv; do
        [ ! -e "$final" ] || cmp "$final" "undisturbed/${final#out/}"  # whole or absent
      done
    done
    run_to_end "${line[@]}" "${jobs[@]}" || { echo "$name does not come to its end"; tail log; exit 1; }
  done
  books
  found=$(leftovers | wc -l)
  [ "$found" -eq 0 ] || { echo "round $rounds leaves $found temporary files:"; leftovers; exit 1; }
  diff -r undisturbed out || { echo "round $rounds differs"; exit 1; }
done
went_on=$(grep -c 'resumes after' log) || true
[ "$kills" -lt 20 ] || [ "$went_on" -gt 0 ] || { echo "no run was ever resumed"; exit 1; }
echo "$all kills in $rounds rounds over $houses houses (${names[*]}: ${killed[*]@K}), $went_on runs resumed after a record: all outputs are the same, no temporary file is left"
