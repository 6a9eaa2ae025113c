#!/usr/bin/env bash
# Makes docs/experiments/ anew: the reports of the experiments in examples/experiments, as tables and figures.
#   docs/experiments.sh [--check] [NAME…]     without names: all of them; --check: only says what differs
set -euo pipefail
cd "$(dirname "$0")/.."
check=
[ "${1-}" != --check ] || { check=1; shift; }
[ $# -gt 0 ] || set -- $(cd examples/experiments && ls -- *.yaml | sed 's/[.]yaml$//')
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
examples/experiments/run.sh "$work" "$@"
for name in "$@"; do
  mkdir -p "$work/pages/$name"
  # The commit would change the page with every change of the program.
  sed 's/ (commit [^)]*)//' "$work/$name/report.md" > "$work/pages/$name/report.md"
  [ ! -d "$work/$name/figures" ] || cp -r "$work/$name/figures" "$work/pages/$name/"
  [ -z "$check" ] || { diff -r "$work/pages/$name" "docs/experiments/$name"; continue; }
  rm -rf "docs/experiments/$name"
  mkdir -p docs/experiments
  cp -r "$work/pages/$name" docs/experiments/
done
