#!/usr/bin/env bash
# Opens the report of an experiment in a headless Chromium: all its plots are drawn, and nothing is loaded. Without Chromium it says
# `skipped` (exit code 77).
#   tests/view/report.sh [ORIEL]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
oriel=$(realpath "${1:-$here/../../build/release/cli/oriel}")
if ! command -v chromium >/dev/null; then
  echo "skipped: no chromium; tests/view/test.sh --install installs it"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat > "$work/plots.yaml" <<END
schema: oriel-experiment/1
name: plots
sets:
  samples:
    models: $here/../../examples/samples/*.stripped.city.json
    truth: $here/../../examples/samples/*.truth.json
rules: residential
sweep: {params: [door_height, ledge_depth], values: 3}
ablate: rules
compare: {high parapet: {params: {parapet: 1.1 m}}}
END
"$oriel" experiment run "$work/plots.yaml" -o "$work/out"
chromium --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile" --virtual-time-budget=20000 --dump-dom \
  "file://$work/out/report.html" > "$work/page.html" 2>/dev/null
if ! grep -q '<body data-plots="3">' "$work/page.html"; then
  echo "not all plots were drawn: $(grep -o '<body[^>]*>' "$work/page.html")"
  exit 1
fi
drawn=$(grep -o '<svg[^>]*class="marks"' "$work/page.html" | wc -l)
[ "$drawn" -eq 3 ] || { echo "$drawn plots instead of 3"; exit 1; }
