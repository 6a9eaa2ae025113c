#!/usr/bin/env bash
# make_deb.sh [-DOPTION=VALUE...]
# Makes the Debian packages oriel, liboriel-dev, oriel-doc and python3-oriel in build/package/packages, on a bare Debian 12:
# installs what is missing, builds oriel in build/package, packs it, and has lintian judge the packages.
set -euo pipefail
cd "$(dirname "$0")/.."

examples/install_packages.sh --build dpkg-dev file gzip help2man lintian pybind11-dev python3-dev
tree=build/package
packages=$tree/packages
log=$tree.log
mkdir -p "$tree"
cmake --preset release -B "$tree" -DCMAKE_INSTALL_PREFIX=/usr -DORIEL_TESTS=OFF -DORIEL_PYTHON=ON -DORIEL_UNITY=ON "$@" >"$log" 2>&1 || { cat "$log"; exit 1; }
echo "building oriel (some minutes the first time)"
cmake --build "$tree" 2>&1 | tee "$log" | examples/show_progress.sh || { tail -n 40 "$log"; exit 1; }

echo "packing"
rm -rf "$packages"
(cd "$tree" && cpack -G DEB) >"$log" 2>&1 || { cat "$log"; exit 1; }
rm -rf "$packages/_CPack_Packages"
echo "checking the packages with lintian"
flags=()
if [ "$(id -u)" -eq 0 ]; then flags=(--allow-root); fi
lintian "${flags[@]}" --fail-on error,warning "$packages"/*.deb

echo
echo "The packages (apt install ./$packages/oriel_*.deb installs the command):"
ls -1 "$PWD/$packages"/*.deb
