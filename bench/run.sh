#!/usr/bin/env bash
# Measures on one core, in a release build: `run.sh line` the whole line and each stage, `run.sh segment` segmentation and
# solidify over size, irregularity and order, `run.sh generalise` a scale and a series of eight over size, with their peak memory. Further arguments go to Google Benchmark, such as
# --benchmark_filter=solid --benchmark_repetitions=5.
set -euo pipefail
cd "$(dirname "$0")/.."
case ${1-} in
  line | segment | generalise) ;;
  *)
    echo "usage: bench/run.sh line|segment|generalise [--benchmark_...]" >&2
    exit 2
    ;;
esac
examples/install_packages.sh
cmake --preset release -DORIEL_BENCH=ON >/dev/null
cmake --build --preset release --target "bench_$1" >&2
exec "build/release/bench/bench_$1" "${@:2}"
