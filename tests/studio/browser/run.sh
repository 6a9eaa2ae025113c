#!/usr/bin/env bash
# Opens the studio in a headless Chromium and does what a person does in it: the steps are the *.mjs files of steps/, in the order of
# their names. Without node, npm or Chromium, or where playwright-core cannot be had, it says `skipped` (exit code 77).
#   tests/studio/browser/run.sh [--install] [--pictures FOLDER] [ORIEL [FOLDER FOR PACKAGES [STEP...]]]
# --install installs what is missing, as Debian has it; --pictures keeps the pictures of the steps. STEP: a part of the name of one.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../../browser_tools.sh"
while [ $# -gt 0 ]; do
  case $1 in
    --install) install_missing ;;
    --pictures) ORIEL_PICTURES=$(realpath -m "$2"); export ORIEL_PICTURES; shift ;;
    *) break ;;
  esac
  shift
done
oriel=$(realpath "${1:-$here/../../../build/release/cli/oriel}")
packages=$(realpath -m "${2:-$here/../../../build/release/tests/studio_browser}")
shift $(($# < 2 ? $# : 2))
need_programs
# Chromium is Debian's: playwright-core brings no browser.
need_packages "$here" "$packages" 60
exec node "$here/runner.mjs" "$oriel" "$(command -v chromium)" "$packages" "$@"
