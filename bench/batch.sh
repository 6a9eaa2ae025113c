#!/usr/bin/env bash
# A whole city: how fast, how much memory, one hash, and input that is bad in large. Prints the table of docs/results.md.
#   bench/batch.sh [HOUSES=20000] [ORIEL] [GENERATOR]
# Needs a release build and some 4 GB in $TMPDIR for 20,000 houses. Figures "of a core" are processor seconds (user + system),
# as other work on the machine does not count there; "elapsed" is by the clock.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
houses=${1:-20000}
oriel=$(realpath "${2:-$root/build/release/cli/oriel}")
generate=$(realpath "${3:-$root/build/release/examples/generator/oriel-generate}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
TIMEFORMAT='%R %U %S'

say() { printf '| %s | %s |\n' "$1" "$2"; }
calc() { awk "BEGIN { printf \"$1\", $2 }"; }
# run COMMAND…: sets elapsed_s and core_s; exit 3 is no failure.
run() {
  local times
  times=$({ time { "$@" >/dev/null 2>messages || [ $? -eq 3 ]; }; } 2>&1)
  read -r elapsed_s user_s system_s <<<"$times"
  core_s=$(calc %.2f "$user_s + $system_s")
}
# The number that STEM.status.json has for a key.
of_status() { sed -n "s/^ *\"$2\": \([0-9]*\).*/\1/p" "$1.status.json" | head -1; }

echo "$("$oriel" --version | head -n 1), $(nproc) cores, $(date +%F), load $(cut -d' ' -f1 /proc/loadavg)"
printf '| figure | value |\n|---|---|\n'

"$generate" -o city.city.jsonl --seed 5 --count "$houses" >/dev/null
mb=$(calc %.0f "$(stat -c %s city.city.jsonl) / 1e6")
say "city" "$houses LoD3 houses, $mb MB"
run "$oriel" cat city.city.jsonl -o cat.city.jsonl
cat_core_s=$core_s
cmp -s city.city.jsonl cat.city.jsonl || { echo "cat changes the city"; exit 1; }
rm cat.city.jsonl
say "\`cat\`, MB/s of a core" "$(calc %.0f "$mb / $core_s")"
run "$oriel" label city.city.jsonl -o label.city.jsonl --status one
one_elapsed_s=$elapsed_s one_core_s=$core_s
say "\`label\`, houses/s of a core" "$(calc %.0f "$houses / $core_s") ($elapsed_s s elapsed, $core_s s of the core)"
say "\`label\` / \`cat\`" "$(calc %.1f "$core_s / $cat_core_s")"
run "$oriel" label city.city.jsonl -o two.city.jsonl -j 2
cmp -s label.city.jsonl two.city.jsonl || { echo "-j 2 writes other bytes"; exit 1; }
say "\`label -j 2\`, times as fast as \`-j 1\`" "$(calc %.2f "$one_elapsed_s / $elapsed_s") ($elapsed_s s elapsed, $core_s s of the cores)"
rm two.city.jsonl label.city.jsonl

# The same city as one record.
"$oriel" collect city.city.jsonl -o city.city.json
"$oriel" label city.city.json -o label.city.json --status file 2>/dev/null || [ $? -eq 3 ]
say "peak memory, one CityJSON file, times its bytes" "$(calc %.1f "$(of_status file peak_memory_bytes) / $(stat -c %s city.city.json)")"
rm city.city.json label.city.json

"$generate" -o lod2.city.jsonl --seed 5 --count "$houses" --features wing >/dev/null
run "$oriel" label lod2.city.jsonl -o lod2.out.city.jsonl
say "\`label\` of LoD2-like houses (walls, roofs, wings), houses/s of a core" "$(calc %.0f "$houses / $core_s")"
rm lod2.city.jsonl lod2.out.city.jsonl

# A stream of 2 GB, which is nowhere on disk: the city three times, a house a line.
big=$((houses * ${BATCH_MB:-2000} / mb + 1))
for jobs in 1 2; do
  "$generate" -o - --seed 9 --count "$big" 2>/dev/null | "$oriel" label - -o /dev/null --to cityjsonseq --status "big$jobs" -j "$jobs" 2>/dev/null || [ $? -eq 3 ]
  say "peak memory, stream of $big houses, \`-j $jobs\`" "$(calc %.0f "$(of_status "big$jobs" peak_memory_bytes) / 1048576") MB"
done

# One hash over jobs, sizes of shards, and orders of shards.
some=$((houses < 240 ? houses : 240))
head -$((some + 1)) city.city.jsonl >some.city.jsonl
"$oriel" label some.city.jsonl -o some.out.city.jsonl 2>/dev/null
sha256sum <some.out.city.jsonl >hashes
runs=0
for size in 7 50 111; do
  "$oriel" split some.city.jsonl --count "$size" -o "shards$size/" 2>/dev/null
  for jobs in 1 2 4 8; do
    for order in 1 2 3; do
      rm -rf done && mkdir done
      for shard in $(cd "shards$size" && ls ./*.city.jsonl | shuf --random-source=<(yes "$order$size$jobs")); do
        "$oriel" label "shards$size/$shard" -o "done/$shard" --status "done/${shard%.city.jsonl}" -j "$jobs" 2>/dev/null
      done
      "$oriel" merge $(ls done/*.city.jsonl | shuf --random-source=<(yes "$jobs$order")) --split "shards$size/split.json" -o merged.city.jsonl 2>/dev/null
      sha256sum <merged.city.jsonl >>hashes
      runs=$((runs + 1))
    done
  done
done
say "SHA-256 of $some houses, one run and $runs runs over -j 1/2/4/8, 3 sizes and 3 orders of shards" "$(sort -u hashes | wc -l): \`$(head -c 16 hashes)…\`"

# A record of 200 MB among others: an attribute, then a geometry.
head -3 city.city.jsonl >large.city.jsonl
sed -n 4p city.city.jsonl | awk '{ at = index($0, "\"type\":\"Building\""); printf "%s", substr($0, 1, at - 1); printf "\"attributes\":{\"note\":\""
  for (i = 0; i < 200000; ++i) printf "%01000d", i; print "\"}," substr($0, at) }' >>large.city.jsonl
sed -n 5p city.city.jsonl | awk '{ printf "%s", substr($0, 1, length($0) - 2)
  for (i = 0; i < 9000000; ++i) printf ",[%d,%d,%d]", i % 4096, i % 512, i; print "]}" }' >>large.city.jsonl
sed -n 6,9p city.city.jsonl >>large.city.jsonl
run "$oriel" label large.city.jsonl -o large.out.city.jsonl --status large
say "records of $(awk '{ if (length($0) > 1e8) printf "%s%d MB", (n++ ? " and " : ""), length($0) / 1000000 }' large.city.jsonl) among 6 others" "$(of_status large done) of $(of_status large buildings) labelled in $elapsed_s s, peak $(calc %.0f "$(of_status large peak_memory_bytes) / 1048576") MB"
rm large*

# A full disk, where there is leave to mount one.
mkdir small
if mount -t tmpfs -o size=2m tmpfs small 2>/dev/null; then
  code=0
  "$oriel" label some.city.jsonl -o small/out.city.jsonl --status small/out 2>messages || code=$?
  say "disk of 2 MB" "exit code $code, $(ls small | wc -l) files left: $(grep -o 'E601.*' messages)"
  umount small
fi
