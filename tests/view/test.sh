#!/usr/bin/env bash
# Opens a page of `oriel view` in a headless Chromium, clicks on parts of the sample house and compares what it says with
# `oriel explain`. Without Chromium it says `skipped` (exit code 77), with --install it installs Debian's.
#   tests/view/test.sh [--install] [--picture FILE.png] [ORIEL]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
picture=
while [ $# -gt 0 ]; do
  case $1 in
    --install) command -v chromium >/dev/null || {
      root=()
      if [ "$(id -u)" -ne 0 ]; then root=(sudo); fi
      echo "installing chromium"
      export DEBIAN_FRONTEND=noninteractive
      "${root[@]}" apt-get update -qq
      "${root[@]}" apt-get install -y -qq --no-install-recommends chromium >/dev/null
    } ;;
    --picture) picture=$(realpath -m "$2"); shift ;;
    *) break ;;
  esac
  shift
done
oriel=$(realpath "${1:-$here/../../build/release/cli/oriel}")
if ! command -v chromium >/dev/null || ! command -v python3 >/dev/null; then
  echo "skipped: no chromium, or no python3; $0 --install installs chromium"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 "$here/clicks.py" "$oriel" "$(command -v chromium)" "$here/../../examples/samples/house.stripped.city.json" "$work" ${picture:+"$picture"}
