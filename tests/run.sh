#!/usr/bin/env bash
# Builds oriel and runs all its tests: what the README says, and what CI runs. Works on a bare Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

# The programs of the last line read tables.
examples/install_packages.sh dpkg-dev file gdal-bin help2man \
  csvkit python3-geopandas python3-pandas
# Pages are tested in a browser: what is there already, from Debian or elsewhere, is taken; without one these tests are skipped.
browser=()
for program in chromium node npm; do command -v $program >/dev/null || browser+=("$program"); done
if [ ${#browser[@]} -gt 0 ]; then
  examples/install_packages.sh "${browser[@]/#node/nodejs}" || echo "no ${browser[*]}: tests in a browser are skipped"
fi

echo "== format"
find bench cli examples experiments generalise interpret io kernel model oriel python studio tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 -n 200 -P "$(nproc)" clang-format --dry-run -Werror

echo "== build"
cmake --preset release -DORIEL_TESTS=ON -DORIEL_SANITIZED_TESTS=ON -DORIEL_BENCH=ON -DORIEL_PYTHON=ON -DORIEL_UNITY=ON
cmake --build --preset release

echo "== tests"
# One more at once than there are cores: tests in a browser wait for part of their time.
status=0
ctest --preset release --parallel "$(($(nproc) + 1))" "$@" || status=$?
# What failed says so once more at the end, where a reader of a long log looks.
if [ "$status" -ne 0 ]; then
  awk '/^[0-9]+\/[0-9]+ Testing: /{text = ""} {text = text $0 "\n"} /^Test Failed\.$/{printf "%s\n", text}' build/release/Testing/Temporary/LastTest.log
fi
exit "$status"
