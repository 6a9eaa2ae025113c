#!/usr/bin/env bash
# tests/fuzz/run.sh MINUTES [TARGET…]: builds the fuzz targets and runs them for so many minutes together, each for its share, on
# all cores. Without targets: all of them. Prints what came of each; exit code 1 if anything was found. What was found stays
# in build/fuzz/found/TARGET, corpora as they have grown in build/fuzz/grown/TARGET.
#   ORIEL_FUZZ_MINIMISE=1  afterwards the files of the corpora that add nothing to the others are left out (in tests/fuzz/corpus)
#   ORIEL_FUZZ_JOBS=N      processes at the same time; default: one a core
#   ORIEL_FUZZ_LONGEST=N   seconds that one input may take (5): more on a machine that others use
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,8s/^# *//p' "$0" >&2; exit 2; }
cd "$(dirname "$0")/../.."
root=$PWD
minutes=$1
shift
jobs=${ORIEL_FUZZ_JOBS:-$(nproc)}
longest_s=${ORIEL_FUZZ_LONGEST:-5}  # longer is a hang
most_mb=4096  # more is a leak, or bytes that ask for too much
build=$root/build/fuzz
fuzz=$root/tests/fuzz

targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for file in "$fuzz"/readers/*.cpp "$fuzz"/geometry/*.cpp; do
    if [ -f "$file" ]; then targets+=("$(basename "$file" .cpp)"); fi
  done
fi

examples/install_packages.sh clang-16 libclang-rt-16-dev
cmake --preset fuzz >"$root/build/fuzz.log" 2>&1 || { cat "$root/build/fuzz.log" >&2; exit 2; }
cmake --build --preset fuzz --target "${targets[@]/#/fuzz_}" >>"$root/build/fuzz.log" 2>&1 || { tail -n 40 "$root/build/fuzz.log" >&2; exit 2; }

dictionary_of() {
  case $1 in
    cityjson | cityjson_seq | level) echo json ;;
    citygml) echo citygml ;;
    obj | off | ply | stl) echo mesh ;;
    packs | profiles | expressions) echo rules ;;
    feature_tables | truth | corrections | operations | journal | status) echo records ;;
  esac
}

# Runs one target for $2 seconds.
run_target() {
  local target=$1 seconds=$2 words
  mkdir -p "$build/found/$target" "$build/grown/$target" "$build/logs" "$fuzz/corpus/$target"
  words=$(dictionary_of "$target")
  local options=(-max_total_time="$seconds" -timeout="$longest_s" -rss_limit_mb="$most_mb" -artifact_prefix="$build/found/$target/"
    -print_final_stats=1 -use_value_profile=0 -verbosity=1)
  if [ -n "$words" ]; then options+=(-dict="$fuzz/dictionaries/$words.dict" -max_len=16384); else options+=(-max_len=256); fi
  if [ -d "$fuzz/regressions/$target" ]; then options+=("$build/grown/$target" "$fuzz/corpus/$target" "$fuzz/regressions/$target")
  else options+=("$build/grown/$target" "$fuzz/corpus/$target"); fi
  "$build/tests/fuzz/fuzz_$target" "${options[@]}" >"$build/logs/$target.log" 2>&1 || true
}

# "target executions per_second coverage found slowest_s"
report() {
  local target=$1 log="$build/logs/$1.log" runs rate cover found slowest
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
  slowest=$(sed -n 's/^stat::slowest_unit_time_sec: *//p' "$log")
  cover=$(grep -o ' cov: [0-9]*' "$log" | tail -n 1 | tr -dc 0-9 || true)
  found=$(find "$build/found/$target" -type f ! -name 'slow-unit-*' | wc -l)
  printf '%-16s %12s %10s %10s %6s %8s\n' "$target" "${runs:-?}" "${rate:-?}" "${cover:-?}" "$found" "${slowest:-?}"
}

share_s=$((minutes * 60 * jobs / ${#targets[@]}))
if [ "$share_s" -lt 1 ]; then share_s=1; fi
for target in "${targets[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
  run_target "$target" "$share_s" &
done
wait

if [ -n "${ORIEL_FUZZ_MINIMISE:-}" ]; then
  for target in "${targets[@]}"; do
    rm -rf "$build/minimal/$target"
    mkdir -p "$build/minimal/$target"
    "$build/tests/fuzz/fuzz_$target" -merge=1 -max_len=2048 -timeout="$longest_s" "$build/minimal/$target" "$fuzz/corpus/$target" \
      "$build/grown/$target" >"$build/logs/$target.merge.log" 2>&1 || true
  done
fi

printf '%-16s %12s %10s %10s %6s %8s\n' target executions a_second coverage found slowest_s
total=0
for target in "${targets[@]}"; do
  report "$target"
  total=$((total + $(find "$build/found/$target" -type f ! -name 'slow-unit-*' | wc -l)))
done
if [ "$total" -gt 0 ]; then
  echo "found: $total, in build/fuzz/found (logs: build/fuzz/logs)"
  exit 1
fi
