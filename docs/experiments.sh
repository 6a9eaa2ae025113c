#!/usr/bin/env bash
# Makes docs/experiments/ anew: the reports of the experiments in examples/experiments, as tables and figures. tests/examples/reports_test.sh
# compares the small ones with what the program says.
#   docs/experiments.sh [NAME…]     without names: all of them
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- $(cd examples/experiments && ls -- *.yaml | sed 's/[.]yaml$//')
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
examples/experiments/run.sh "$work" "$@"
for name in "$@"; do
  rm -rf "docs/experiments/$name"
  mkdir -p "docs/experiments/$name"
  # The commit would change the page with every change of the program.
  sed 's/ (commit [0-9a-f+]*)//' "$work/$name/report.md" > "docs/experiments/$name/report.md"
  [ ! -d "$work/$name/figures" ] || cp -r "$work/$name/figures" "docs/experiments/$name/"
done
