#!/usr/bin/env bash
# Makes dist/ out of src/: checks the types, bundles the two pages and collects the licences of what is bundled. Only developers of
# the page run it; the bundles are committed and compiled into the program.
#   studio/page/bundle.sh [--quick]        --quick leaves out the check of types
set -euo pipefail
cd "$(dirname "$0")"
if [ ! -d node_modules ]; then npm install --no-package-lock --no-audit --no-fund; fi
if [ "${1:-}" != --quick ]; then node_modules/.bin/tsc --noEmit; fi
node bundle.mjs
