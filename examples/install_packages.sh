#!/usr/bin/env bash
# install_packages.sh [--build] [PACKAGE...]
# Installs what Debian 12 has for building and testing oriel, where it is missing, and the packages that are given besides;
# with --build only what building takes. Asks for nothing and downloads nothing else.
set -euo pipefail

packages=(
  cmake g++ ninja-build
  libcgal-dev libopenmesh-dev libboost-dev libgmp-dev libmpfr-dev
  libyaml-cpp-dev libspdlog-dev libfmt-dev libcli11-dev libsimdjson-dev libexpat1-dev libproj-dev libsqlite3-dev zlib1g-dev libmeshoptimizer-dev nlohmann-json3-dev libutfcpp-dev libtbb-dev libmimalloc-dev nettle-dev libnlopt-cxx-dev libcairo2-dev libpolyclipping-dev fonts-dejavu-core
)
if [ "${1:-}" = --build ]; then
  shift
else
  packages+=(clang-format doctest-dev librapidcheck-dev libbenchmark-dev libeigen3-dev pybind11-dev python3-dev python3-numpy)
fi
packages+=("$@")

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

root=()
if [ "$(id -u)" -ne 0 ]; then root=(sudo); fi
export DEBIAN_FRONTEND=noninteractive
faults=$(mktemp)
trap 'rm -f "$faults"' EXIT

# apt's own percentages, of downloads (dlstatus) and then of installing (pmstatus), as [done/all].
install_missing() {
  "${root[@]}" apt-get install -y -qq --no-install-recommends -o APT::Status-Fd=1 "${missing[@]}" 2>"$faults" |
    sed -un 's/^\(dl\|pm\)status:[^:]*:\([0-9]*\)[.0-9]*:.*/[\2\/100] \1/p' | "$(dirname "$0")/show_progress.sh"
}

echo "installing ${missing[*]}"
if ! install_missing; then
  echo "reading the list of Debian's packages"
  "${root[@]}" apt-get update -q
  install_missing || { cat "$faults" >&2; exit 1; }
fi
