#!/usr/bin/env bash
# Opens the studio in a headless Chromium and does what a person does in it: the steps are the *.mjs files of steps/, in the order of
# their names. Without node, npm or Chromium, or where playwright-core cannot be had, it says `skipped` (exit code 77).
#   tests/studio/browser/run.sh [--install] [--pictures FOLDER] [ORIEL [FOLDER FOR PACKAGES [STEP...]]]
# --install installs what is missing, as Debian has it; --pictures keeps the pictures of the steps. STEP: a part of the name of one.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
missing=()
find_missing() {
  missing=()
  local program
  for program in node npm chromium; do command -v "$program" >/dev/null || missing+=("$program"); done
}
while [ $# -gt 0 ]; do
  case $1 in
    --install)
      find_missing
      if [ ${#missing[@]} -gt 0 ]; then "$here/../../../examples/install_packages.sh" "${missing[@]/#node/nodejs}"; fi ;;
    --pictures) ORIEL_PICTURES=$(realpath -m "$2"); export ORIEL_PICTURES; shift ;;
    *) break ;;
  esac
  shift
done
oriel=$(realpath "${1:-$here/../../../build/release/cli/oriel}")
packages=$(realpath -m "${2:-$here/../../../build/release/tests/studio_browser}")
shift $(($# < 2 ? $# : 2))
find_missing
if [ ${#missing[@]} -gt 0 ]; then
  echo "skipped: no ${missing[*]}; $0 --install installs it"
  exit 77
fi
# The lock names one version and its hash. Chromium is Debian's: playwright-core brings no browser.
mkdir -p "$packages"
if ! cmp -s "$here/package-lock.json" "$packages/node_modules/lock"; then
  cp "$here/package.json" "$here/package-lock.json" "$packages/"
  if ! (cd "$packages" && timeout 60 npm ci --no-audit --no-fund --ignore-scripts --fetch-retries=1 >npm.log 2>&1); then
    tail -3 "$packages/npm.log"
    echo "skipped: playwright-core cannot be had from the registry"
    exit 77
  fi
  cp "$here/package-lock.json" "$packages/node_modules/lock"
fi
exec node "$here/runner.mjs" "$oriel" "$(command -v chromium)" "$packages" "$@"
