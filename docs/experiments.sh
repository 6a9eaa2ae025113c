#!/usr/bin/env bash
# Makes docs/experiments/ anew: the reports of the experiments in examples/experiments, as tables and figures.
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
  cp -r "$work/$name/report.md" "docs/experiments/$name/"
  [ ! -d "$work/$name/figures" ] || cp -r "$work/$name/figures" "docs/experiments/$name/"
done
