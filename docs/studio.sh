#!/usr/bin/env bash
# Makes the pictures of docs/studio.md anew, by the steps of the browser tests. Needs Chromium, Node and playwright-core
# (tests/studio/browser/run.sh --install gets them). Usage: docs/studio.sh [ORIEL]
set -euo pipefail
cd "$(dirname "$0")/.."
oriel=$(realpath "${1:-build/release/cli/oriel}")
tests/studio/browser/run.sh --pictures docs/studio "$oriel" build/release/tests/studio_browser author building city 22_phone
# The steps take more pictures than the page shows.
for picture in docs/studio/*.png; do grep -qF "studio/$(basename "$picture")" docs/studio.md README.md || rm "$picture"; done
