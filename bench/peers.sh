#!/usr/bin/env bash
# Segmentation beside the peers of ../shared/peers (or $ORIEL_SHARED/peers), same buildings, one run, one thread. First the
# milliseconds of processor time, then the ratios to `segment` alone (solid in memory to tree, cells and features) and to
# solidify + segment (polygons in memory to the same). The peers start from a mesh of their own in memory:
#   pmp-split, pmp-clip  CGAL Polygon Mesh Processing, split or clip at every plane: one level of the recursion, no tree
#   nef-halves CGAL Nef, body and complement cut by the half-space of every plane: one level, no tree
#   nef-convex CGAL Nef, convex decomposition: all pieces, no tree; left out for 2000 windows, where it takes minutes
#   prototype  the throw-away kernel of the project's design, in doubles: the whole tree
# The two of one level are measured at some 10 (pmp) and 3 (nef) planes and scaled to all. oriel and pmp take nine turns, as
# the clock of a machine changes within seconds: the one with the median ratio stands here. Takes two to four minutes.
#   bench/peers.sh [natural|paper]   the order of cuts; paper, as the peers know no other
set -euo pipefail
cd "$(dirname "$0")/.."
order=${1:-paper}
peers=${ORIEL_SHARED:-../shared}/peers/segmentation
[ -d "$peers" ] || { echo "skipped: no peers at $peers"; exit 0; }
examples/install_packages.sh
cmake --preset release -DORIEL_BENCH=ON >/dev/null
cmake --build --preset release --target bench_timed_calls >&2
work=build/peers
mkdir -p "$work"
for peer in gen prototype pmp nef; do
  [ "$work/$peer" -nt "$peers/$peer.cpp" ] || g++ -O3 -DNDEBUG -std=c++20 "$peers/$peer.cpp" -o "$work/$peer" -lgmp -lmpfr
done

# to_metres MM.off M.off: the peers work in millimetres.
to_metres() {
  awk 'NR <= 2 { print; if (NR == 2) n = $1; next }
       NR <= 2 + n { printf "%.3f %.3f %.3f\n", $1 / 1000, $2 / 1000, $3 / 1000; next } { print }' "$1" >"$2"
}
# Each prints milliseconds, or nothing where it failed.
# Split, then clip.
pmp() {
  "$work/pmp" "$1" 10 2>&1 |
    sed -n 's/.* done=[0-9]*\/\([0-9]*\) clip=\([0-9.]*\)(fail [0-9]*) split=\([0-9.]*\)(fail .*/\1 \2 \3/p' |
    awk '{ print 1000 * $1 * $3, 1000 * $1 * $2 }'
}
# BUILDING RUNS: solidify, segment, split, clip of the turn whose split / segment is the median.
in_turns() {
  for _ in 1 2 3 4 5 6 7 8 9; do
    echo "$(build/release/bench/bench_timed_calls "$work/$1.off" "$order" "$2") $(pmp "$work/$1.mm.off")"
  done | awk '{ printf "%.4f %s\n", $3 / $2, $0 }' | sort -n | sed -n '5s/^[^ ]* //p'
}
nef_halves() {
  "$work/nef" planes "$1" 3 2>&1 |
    sed -n 's/.* done=[0-9]*\/\([0-9]*\) prot_mean=\([0-9.]*\) hole_mean=\([0-9.]*\) .*/\1 \2 \3/p' |
    awk '{ print 1000 * $1 * ($2 + $3) }'
}
nef_convex() { "$work/nef" conv "$1" 2>&1 | sed -n 's/.* convex_decomp .* cpu=\([0-9.]*\) .*/\1/p' | awk '{ print 1000 * $1 }'; }
prototype() { "$work/prototype" "$1" "$2" | sed -n 's/.* median=\([0-9.]*\)ms .*/\1/p'; }

# Name, windows in x and y, floors, jitter, runs of oriel and prototype, whether nef-convex runs.
while read -r name nx ny floors jitter runs convex; do
  "$work/gen" "$nx" "$ny" "$floors" "$jitter" 0 0 "$work/$name.mm.off" >/dev/null 2>&1
  to_metres "$work/$name.mm.off" "$work/$name.off"
  taken=$(in_turns "$name" "$runs")
  pieces=-
  [ "$convex" = no ] || pieces=$(nef_convex "$work/$name.mm.off")
  echo "$name $taken $(nef_halves "$work/$name.mm.off") ${pieces:--} \
    $(prototype "$work/$name.mm.off" "$runs")"
done <<'BUILDINGS' | awk -v order="$order" '
  BEGIN {
    print "milliseconds of processor time, order " order
    peers = sprintf(" | %12s%12s%12s%12s%12s\n", "pmp-split", "pmp-clip", "nef-halves", "nef-convex", "prototype")
    printf "%-16s%12s%12s%12s%s", "building", "solidify", "segment", "both", peers
  }
  function ms(value, digits) { return value == "-" ? "-" : sprintf("%." digits "f", value) }
  function ratio(peer, own) { return peer == "-" ? "-" : sprintf(peer < 10 * own ? "%.2f" : "%.0f", peer / own) }
  function ratios(own) {
    return sprintf("%-16s | %12s%12s%12s%12s%12s\n", $1, ratio($4, own), ratio($5, own), ratio($6, own), ratio($7, own),
                   ratio($8, own))
  }
  {
    printf "%-16s%12s%12s%12s | %12s%12s%12s%12s%12s\n", $1, ms($2, 2), ms($3, 2), ms($2 + $3, 2), ms($4, 0), ms($5, 0),
           ms($6, 0), ms($7, 0), ms($8, 2)
    fflush()
    alone = alone ratios($3)
    whole = whole ratios($2 + $3)
  }
  END {
    printf "\npeer / segment: how many times as long a peer takes\n%-16s%s%s", "building", peers, alone
    printf "\npeer / (solidify + segment)\n%-16s%s%s", "building", peers, whole
  }'
regular-20 3 2 2 0 25 yes
regular-100 5 5 5 0 25 yes
regular-500 13 8 12 0 9 yes
regular-2000 40 10 20 0 5 no
jittered-20 3 2 2 1 25 yes
jittered-100 5 5 5 1 25 yes
jittered-500 13 8 12 1 5 yes
jittered-2000 40 10 20 1 3 no
BUILDINGS
