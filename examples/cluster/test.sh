#!/usr/bin/env bash
# Runs the Snakefile on 16 shards with two local jobs, kills it half-way, restarts it, and compares the bytes with those of single runs.
# Installs Snakemake (Debian's) where it is missing.
#   examples/cluster/test.sh [ORIEL] [GENERATOR]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
oriel=$(realpath "${1:-$here/../../build/release/cli/oriel}")
generator=$(realpath "${2:-$here/../../build/release/examples/generator/oriel-generate}")

if ! command -v snakemake >/dev/null; then
  root=()
  if [ "$(id -u)" -ne 0 ]; then root=(sudo); fi
  echo "installing snakemake"
  export DEBIAN_FRONTEND=noninteractive
  "${root[@]}" apt-get update -qq
  "${root[@]}" apt-get install -y -qq --no-install-recommends snakemake >/dev/null
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export HOME=$work XDG_CACHE_HOME=$work/cache
"$generator" -o city.city.jsonl --count 640 --seed 5 >/dev/null
code=0
"$oriel" label city.city.jsonl -o single.city.jsonl 2>/dev/null || code=$?
[ "$code" -eq 0 ] || [ "$code" -eq 3 ]
code=0
"$oriel" generalise single.city.jsonl --scale 1:5000 -o small.city.jsonl 2>/dev/null || code=$?
[ "$code" -eq 0 ] || [ "$code" -eq 3 ]

snake=(snakemake --snakefile "$here/Snakefile" --cores 2 --rerun-incomplete --config "oriel=$oriel" city=city.city.jsonl features=40)
setsid "${snake[@]}" >first.log 2>&1 &
group=$!
for _ in $(seq 600); do
  [ "$(find label -name '*.done' 2>/dev/null | wc -l)" -ge 6 ] && break
  sleep 0.1
done
kill -9 -- "-$group"
wait "$group" 2>/dev/null || true
done_before=$(find label generalise -name '*.done' 2>/dev/null | wc -l)
if [ "$done_before" -eq 0 ] || [ -e generalised.city.jsonl ]; then
  echo "it was not killed half-way: $done_before jobs were done"
  tail first.log
  exit 1
fi
"${snake[@]}" --unlock >/dev/null 2>&1
"${snake[@]}" >second.log 2>&1 || { tail -50 second.log; exit 1; }
[ "$(ls shards/*.city.jsonl | wc -l)" -eq 16 ]
cmp labelled.city.jsonl single.city.jsonl
cmp generalised.city.jsonl small.city.jsonl
echo "16 shards, killed after $done_before of 32 jobs, restarted: the bytes of single runs"
