#!/usr/bin/env bash
# Measures what the program costs, prints it as tables, and writes them with their pictures beside the results page:
# time per cycle of every engine with its error, time per cell of a map on 1, 2 and 8 ranks, the rate of dealing, memory,
# and the scaling to 100,000 ranks that follows. Takes about half an hour on 2 cores; leave them alone meanwhile.
#   jobs/benchmark.sh [--quick | --huge] [RESULTS_FOLDER [PAGE_FOLDER]]     default: results, postprocess/examples
#   --quick: smaller maps and fewer rounds; --huge: a map of 67 million cells, too
#   PETERKA_BUILD=... jobs/benchmark.sh                                     with another build folder than build
set -euo pipefail
size=()
case "${1:-}" in --quick | --huge) size=("$1"); shift ;; esac
results=$(realpath -m "${1:-$(dirname "$0")/../results}")
page=$(realpath -m "${2:-$(dirname "$0")/../postprocess/examples}")
build=$(realpath -m "${PETERKA_BUILD:-$(dirname "$0")/../build}")
cd "$(dirname "$0")/.."

[ -n "${PETERKA_BUILD:-}" ] || jobs/prepare.sh
cmake --build "$build" --target peterka benchmark
. jobs/mpi_environment.sh
/usr/bin/python3 tests/benchmark/measure.py "${size[@]}" --build "$build" --results "$results" --page "$page/benchmark.md"
