#!/usr/bin/env bash
# Runs the Snakefile on 4 shards with two local jobs, kills it half-way, restarts it, and compares the bytes with those of single runs.
# Where Snakemake is missing it is downloaded (26 MB) into the test's folder; exit code 77 says that it cannot be had.
#   examples/cluster/test.sh [ORIEL] [GENERATOR] [HOUSES OF A SHARD=40]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
oriel=$(realpath "${1:-$here/../../build/release/cli/oriel}")
generator=$(realpath "${2:-$here/../../build/release/examples/generator/oriel-generate}")
houses=${3:-40}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export TMPDIR=$work  # where the solver of Snakemake leaves files when it is killed

# Snakemake as Debian has it, unpacked for this test: nothing of the system changes, and nothing is compiled ahead.
unpack_snakemake() {
  [ -x /usr/bin/python3 ] || return 1
  local packages
  packages=$(apt-get install -s --no-install-recommends snakemake 2>/dev/null | awk '/^Inst/ { print $2 }')
  if [ -z "$packages" ]; then
    { [ "$(id -u)" -eq 0 ] && apt-get update -qq || sudo -n apt-get update -qq; } >/dev/null 2>&1 || return 1
    packages=$(apt-get install -s --no-install-recommends snakemake 2>/dev/null | awk '/^Inst/ { print $2 }')
  fi
  [ -n "$packages" ] || return 1
  mkdir debs root
  # shellcheck disable=SC2086
  (cd debs && apt-get download -qq -o APT::Sandbox::User=root $packages) || return 1
  for deb in debs/*.deb; do dpkg-deb -x "$deb" root; done
  export PYTHONPATH=$work/root/usr/lib/python3/dist-packages PATH=$work/root/usr/bin:$PATH
}
if ! command -v snakemake >/dev/null; then
  began=$(date +%s)
  unpack_snakemake || { echo "skipped: snakemake cannot be had"; exit 77; }
  echo "snakemake took $(($(date +%s) - began)) s"
fi
began=$(date +%s)
export HOME=$work XDG_CACHE_HOME=$work/cache
"$generator" -o city.city.jsonl --count $((4 * houses)) --seed 5 >/dev/null
code=0
"$oriel" label city.city.jsonl -o single.city.jsonl 2>/dev/null || code=$?
[ "$code" -eq 0 ] || [ "$code" -eq 3 ]
code=0
"$oriel" generalise single.city.jsonl --scale 1:5000 -o small.city.jsonl 2>/dev/null || code=$?
[ "$code" -eq 0 ] || [ "$code" -eq 3 ]

snake=(snakemake --snakefile "$here/Snakefile" --cores 2 --rerun-incomplete --config "oriel=$oriel" city=city.city.jsonl "features=$houses")
setsid "${snake[@]}" >first.log 2>&1 &
group=$!
for _ in $(seq 600); do
  [ "$(find label -name '*.done' 2>/dev/null | wc -l)" -ge 2 ] && break
  sleep 0.1
done
kill -9 -- "-$group"
wait "$group" 2>/dev/null || true
# Nothing may have been generalised yet, not even the folder.
done_before=$({ find label generalise -name '*.done' 2>/dev/null || true; } | wc -l)
if [ "$done_before" -eq 0 ] || [ -e generalised.city.jsonl ]; then
  echo "it was not killed half-way: $done_before jobs were done"
  tail first.log
  exit 1
fi
"${snake[@]}" --unlock >/dev/null 2>&1
"${snake[@]}" >second.log 2>&1 || { tail -50 second.log; exit 1; }
[ "$(ls shards/*.city.jsonl | wc -l)" -eq 4 ]
cmp labelled.city.jsonl single.city.jsonl
cmp generalised.city.jsonl small.city.jsonl
echo "4 shards, killed after $done_before of 8 jobs, restarted: the bytes of single runs ($(($(date +%s) - began)) s)"
