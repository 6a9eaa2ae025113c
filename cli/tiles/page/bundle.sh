#!/usr/bin/env bash
# Makes dist/ out of src/: bundles the page into one file and collects the licences of what is bundled. Only developers of the page run
# it; the bundle is committed and compiled into the program.
#   cli/tiles/page/bundle.sh
set -euo pipefail
cd "$(dirname "$0")"
if [ ! -d node_modules ]; then npm install --no-package-lock --no-audit --no-fund; fi
node bundle.mjs
