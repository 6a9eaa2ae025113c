#!/usr/bin/env bash
# Measures the line on one core, in a release build. Arguments go to Google Benchmark, such as
# --benchmark_filter=line --benchmark_repetitions=5.
set -euo pipefail
cd "$(dirname "$0")/.."
examples/install_packages.sh
cmake --preset release -DORIEL_BENCH=ON >/dev/null
cmake --build --preset release --target bench_line >&2
exec build/release/bench/bench_line "$@"
