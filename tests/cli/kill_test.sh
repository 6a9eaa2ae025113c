#!/usr/bin/env bash
# Kills `oriel label`, `oriel generalise` and `oriel tiles` at random moments (kill -9), goes on with the same command, and compares every
# output with that of a run that nobody disturbed.
#   kill_test.sh ORIEL GENERATOR [KILLS=20] [HOUSES=40] [SEED=1]
set -euo pipefail
oriel=$1 generator=$2 kills=${3:-20} houses=${4:-40} RANDOM=${5:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

"$generator" -o city.city.jsonl --count "$houses" --seed 7 >/dev/null
# Bad records, too: one line in twenty is cut off.
awk 'NR > 1 && NR % 20 == 5 { print substr($0, 1, 300); next } { print }' city.city.jsonl >in.city.jsonl

# One run: what is written stands in the folder $1, which is the same path for every run.
label=("$oriel" label in.city.jsonl -o out/label.city.jsonl --features out/parts.csv --status out/label --resume)
redraw=("$oriel" generalise in.city.jsonl --scale 1:5000 -o out/small.city.jsonl --explain out/why.jsonl --status out/small --resume)
tiles=("$oriel" tiles in.city.jsonl -o out/town --scales 1:2500 --crs local --most-triangles 1000 --gzip --status out/town --resume)

now() { date +%s%N; }
run_to_end() { local code=0; "$@" 2>>log || code=$?; [ "$code" -eq 3 ]; }
# Peak memory is what a run may differ in.
books() { sed -i '/peak_memory_bytes/d' out/*.status.json; }

mkdir out
begin=$(now)
run_to_end "${label[@]}"
took_ns=$(($(now) - begin))
run_to_end "${redraw[@]}"
run_to_end "${tiles[@]}"
books
mv out undisturbed

killed=0 rounds=0
while [ "$killed" -lt "$kills" ]; do
  rm -rf out && mkdir out
  rounds=$((rounds + 1))
  for command in label redraw tiles; do
    declare -n line=$command
    jobs=$((RANDOM % 2 + 1))
    for attempt in 1 2 3 4; do
      [ "$killed" -lt "$kills" ] || break
      call=("${line[@]}")
      [ "$attempt" -gt 1 ] || unset 'call[-1]'  # nobody knows before that it will be killed
      "${call[@]}" -j "$jobs" 2>>log &
      process=$!
      wait_ns=$((took_ns * (RANDOM % 1000) / 2500))
      sleep "$((wait_ns / 1000000000)).$(printf %09d $((wait_ns % 1000000000)))"
      if kill -9 "$process" 2>/dev/null; then killed=$((killed + 1)); fi
      wait "$process" 2>/dev/null || true
      for final in out/*.city.jsonl out/*.csv out/town/tileset.json out/town/tiles/*/*.glb; do
        [ ! -e "$final" ] || cmp "$final" "undisturbed/${final#out/}"  # whole or absent
      done
    done
    run_to_end "${line[@]}" -j "$jobs" || { echo "the run did not come to its end"; tail log; exit 1; }
  done
  books
  diff -r undisturbed out || { echo "round $rounds differs"; exit 1; }
done
grep -q "resumes after" log || { echo "no run was ever resumed"; exit 1; }
echo "$killed kills in $rounds rounds over $houses houses, $(grep -c 'resumes after' log) runs resumed after a record: all outputs are the same"
