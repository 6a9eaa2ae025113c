#!/usr/bin/env bash
# Makes docs/cuts-natural.svg and docs/cuts-paper.svg anew: one generated house cut step by step in both orders.
set -euo pipefail
cd "$(dirname "$0")/.."
examples/install_packages.sh
cmake --preset release >/dev/null
cmake --build --preset release --target oriel-generate oriel-cuts >&2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
build/release/examples/generator/oriel-generate --seed 20 --roof gable --storeys 2 --width 9 --depth 8 \
  --features window,door,chimney,dormer,balcony --chimney ridge -o "$work"
for order in natural paper; do
  build/release/examples/cuts/oriel-cuts "$work/house.stripped.city.json" "docs/cuts-$order.svg" "$order"
done
