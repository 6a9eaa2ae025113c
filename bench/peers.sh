#!/usr/bin/env bash
# Segmentation side by side with the peers of ../shared/peers (or $ORIEL_SHARED/peers) on the same buildings in one run:
# CGAL PMP split plane by plane (one level of the recursion), CGAL Nef convex decomposition, and the prototype of the
# project's design. Prints milliseconds and ratios; oriel's are of solidify + segment, paper's order.
set -euo pipefail
cd "$(dirname "$0")/.."
peers=${ORIEL_SHARED:-../shared}/peers/segmentation
[ -d "$peers" ] || { echo "skipped: no peers at $peers"; exit 0; }
examples/install_packages.sh
cmake --preset release >/dev/null
cmake --build --preset release --target oriel >&2
work=build/peers
mkdir -p "$work"
for peer in gen prototype pmp nef; do
  [ -x "$work/$peer" ] || g++ -O3 -DNDEBUG -std=c++20 "$peers/$peer.cpp" -o "$work/$peer" -lgmp -lmpfr
done

# to_metres MM.off M.off: the peers work in millimetres.
to_metres() {
  awk 'NR <= 2 { print; if (NR == 2) n = $1; next }
       NR <= 2 + n { printf "%.3f %.3f %.3f\n", $1 / 1000, $2 / 1000, $3 / 1000; next } { print }' "$1" >"$2"
}
stage() { grep -o "\"$1_ms\":[0-9.]*" "$work/timings.json" | cut -d: -f2; }

printf '%-14s %9s %9s %9s | %9s %6s | %9s %6s | %9s %6s\n' \
  building solidify segment both prototype ratio pmp-level ratio nef-conv ratio
# Name, windows in x and y, floors, jitter, runs, peers that take minutes.
while read -r name nx ny floors jitter runs slow; do
  "$work/gen" "$nx" "$ny" "$floors" "$jitter" 0 0 "$work/$name.mm.off" >/dev/null 2>&1
  to_metres "$work/$name.mm.off" "$work/$name.off"
  build/release/cli/oriel segment "$work/$name.off" --order paper --repeat "$runs" --timings "$work/timings.json" >/dev/null 2>&1
  solidify=$(stage solidify)
  segment=$(stage segment)
  both=$(awk "BEGIN { print $solidify + $segment }")
  prototype=$("$work/prototype" "$work/$name.mm.off" "$runs" | grep -o 'median=[0-9.]*' | cut -d= -f2)
  pmp=- nef=- pmp_ratio=- nef_ratio=-
  if [ "$slow" = yes ]; then
    pmp=$("$work/pmp" "$work/$name.mm.off" 25 2>&1 | grep -o 'split=[0-9.]* diff=[0-9.]* lumps' | cut -d= -f2 | cut -d' ' -f1)
    pmp=$(awk "BEGIN { print 1000 * $pmp }")
    pmp_ratio=$(awk "BEGIN { printf \"%.0f\", $pmp / $both }")
    nef=$("$work/nef" conv "$work/$name.mm.off" 2>&1 | grep -o 'convex_decomp wall=[0-9.]*' | cut -d= -f2)
    nef=$(awk "BEGIN { print 1000 * $nef }")
    nef_ratio=$(awk "BEGIN { printf \"%.0f\", $nef / $both }")
  fi
  printf '%-14s %9.2f %9.2f %9.2f | %9.2f %6.2f | %9s %6s | %9s %6s\n' "$name" "$solidify" "$segment" "$both" \
    "$prototype" "$(awk "BEGIN { print $prototype / $both }")" "$pmp" "$pmp_ratio" "$nef" "$nef_ratio"
done <<'BUILDINGS'
regular-20 3 2 2 0 25 yes
regular-100 5 5 5 0 25 yes
regular-500 13 8 12 0 9 no
regular-2000 40 10 20 0 5 no
jittered-20 3 2 2 1 25 yes
jittered-100 5 5 5 1 25 yes
jittered-500 13 8 12 1 5 no
jittered-2000 40 10 20 1 3 no
BUILDINGS
