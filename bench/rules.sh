#!/usr/bin/env bash
# The eight rules of ../shared/peers/rules (or $ORIEL_SHARED/peers/rules) as a pack, bench/rules/eight.yaml, beside the peers: a
# hand-written loop, SQLite and CLIPS. Same features, one run, one thread, processor time from columns in memory to labels; what
# relates features (facades, hosts) is found within it by all. Labels of oriel, loop and SQLite are compared by their checksum.
# bytes: what a feature takes in oriel, its columns and labels in them. CLIPS takes minutes for 1 M features and is left out there.
# Then the milliseconds to load and check a pack of 200 rules, and what explanations cost: off, beside bare labels, and on. Takes about two minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
peers=${ORIEL_SHARED:-../shared}/peers/rules
[ -d "$peers" ] || { echo "skipped: no peers at $peers"; exit 0; }
examples/install_packages.sh
cmake --preset release -DORIEL_BENCH=ON >/dev/null
cmake --build --preset release --target bench_rules >&2
work=build/rule_peers
mkdir -p "$work"
[ "$work/hand" -nt "$peers/hand.cpp" ] || g++ -O3 -DNDEBUG -std=c++20 "$peers/hand.cpp" -o "$work/hand"
[ "$work/sqlite" -nt "$peers/sqlite.cpp" ] || g++ -O3 -DNDEBUG -std=c++20 "$peers/sqlite.cpp" -o "$work/sqlite" -lsqlite3 ||
  echo "no SQLite: apt-get install libsqlite3-dev" >&2

# field NAME: the value of NAME= in a line.
field() { sed -n "s|.* $1=\([^ ]*\).*|\1|p"; }

clips_rate() {
  command -v clips >/dev/null || { echo "no CLIPS: apt-get install clips" >&2; return; }
  cp "$peers"/*.clp "$work/"
  chmod u+w "$work"/*.clp
  # A batch takes one command a line.
  sed -i -e "s/f10000[.]fct/$1.fct/" -e 's/) (load/)\n(load/g' "$work/mB.clp"
  (cd "$work" && clips -f mB.clp </dev/null) | grep '^CLIPS rules' | field run_s | awk -v n="$2" '{ printf "%.0f", n / $1 }'
}

printf '%-9s%12s%12s%12s%12s | %s\n' features oriel loop sqlite clips "features a second; loop / oriel, oriel / sqlite, oriel / clips, bytes"
for n in 100000 1000000; do
  [ -f "$work/f$n.fct" ] || python3 "$peers/gen.py" "$n" "$work/f$n" >/dev/null
  runs=$((n > 100000 ? 5 : 9))
  own=$(build/release/bench/bench_rules "$work/f$n.csv" bench/rules/eight.yaml "$runs")
  loop=$("$work/hand" "$work/f$n.csv" "$runs")
  sqlite=
  [ ! -x "$work/sqlite" ] || sqlite=$("$work/sqlite" "$work/f$n.csv")
  for peer in "$loop" "$sqlite"; do
    [ -z "$peer" ] || [ "$(field cs <<<"$peer")" = "$(field cs <<<"$own")" ] || { echo "labels differ: $peer / $own" >&2; exit 1; }
  done
  clips=
  [ "$n" -gt 100000 ] || clips=$(clips_rate "f$n" "$n")
  awk -v n="$n" -v o="$(field facts/s <<<"$own")" -v l="$(field facts/s <<<"$loop")" -v s="$(field facts/s <<<"$sqlite")" \
    -v c="$clips" -v kb="$(field rss_kb <<<"$own")" '
    function rate(x) { return x == "" ? "-" : x }
    function ratio(p, q) { return p == "" || q == "" ? "-" : sprintf("%.1f", p / q) }
    BEGIN { printf "%-9d%12s%12s%12s%12s | %s, %s, %s, %.0f\n", n, rate(o), rate(l), rate(s), rate(c), ratio(l, o), ratio(o, s),
                   ratio(o, c), kb * 1024 / n }'
done
build/release/bench/bench_rules --load 200 9
build/release/bench/bench_rules --explain "$work/f100000.csv" bench/rules/eight.yaml 31
