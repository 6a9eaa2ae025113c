#!/usr/bin/env bash
# Builds oriel and runs all its tests: what the README says, and what CI runs. Works on a bare Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

examples/install_packages.sh dpkg-dev file help2man lintian

echo "== format"
find bench cli examples generalise interpret kernel oriel python studio tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 clang-format --dry-run -Werror

echo "== build"
cmake --preset release -DORIEL_TESTS=ON -DORIEL_SANITIZED_TESTS=ON -DORIEL_BENCH=ON -DORIEL_PYTHON=ON -DORIEL_UNITY=ON
cmake --build --preset release

echo "== tests"
ctest --preset release --parallel "$(nproc)" "$@"
