#!/usr/bin/env bash
# Installs what building oriel takes and Debian 12 has, where it is missing, and the packages that are given besides. Asks for
# nothing and downloads nothing else.
set -euo pipefail

packages=(
  cmake g++ ninja-build clang-format
  libcgal-dev libopenmesh-dev libboost-dev libgmp-dev libmpfr-dev
  libyaml-cpp-dev libspdlog-dev libfmt-dev libcli11-dev libsimdjson-dev libexpat1-dev nlohmann-json3-dev libtbb-dev libmimalloc-dev nettle-dev
  doctest-dev librapidcheck-dev libbenchmark-dev libeigen3-dev
  "$@"
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

root=()
if [ "$(id -u)" -ne 0 ]; then root=(sudo); fi
echo "installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
if ! "${root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null 2>&1; then
  "${root[@]}" apt-get update -qq
  "${root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi
