#!/usr/bin/env bash
# Measures what the program costs, prints it as tables, and writes them with their pictures beside the results page:
# time per cycle of every engine with its error, time per cell of a map on 1, 2 and 8 ranks, the rate of dealing, memory,
# the scaling to 100,000 ranks that follows, and how far basin shares are off against the time for them (a page of its own,
# starts.md), how many points of curves a second gives, with which error (curves.md), and what rigid stops and rigs of their own
# cost (laws.md). Takes about half an hour on 2 cores; leave them alone meanwhile.
#   jobs/benchmark.sh [--quick | --huge] [RESULTS_FOLDER [PAGE_FOLDER]]     default: results, postprocess/examples
#   --quick: smaller maps and fewer rounds; --huge: a map of 67 million cells, too
#   PETERKA_BUILD=... jobs/benchmark.sh                                     with another build folder than build
set -euo pipefail
. "$(dirname "$0")/arguments.sh"
read_arguments "--quick --huge" 2 "$@"
! { has_option --quick && has_option --huge; } || refuse "--quick and --huge exclude each other"
results=$(folder_argument "${words[0]:-$(dirname "$0")/../results}")
page=$(folder_argument "${words[1]:-$(dirname "$0")/../postprocess/examples}")
build=$(realpath -m "${PETERKA_BUILD:-$(dirname "$0")/../build}")
[ -z "${PETERKA_BUILD:-}" ] || [ -f "$build/CMakeCache.txt" ] || refuse "PETERKA_BUILD=$PETERKA_BUILD is no build folder"
quick=$(! has_option --quick || echo yes)
cd "$(dirname "$0")/.."

[ -n "${PETERKA_BUILD:-}" ] || jobs/prepare.sh
cmake --build "$build" --target peterka benchmark
. jobs/mpi_environment.sh
/usr/bin/python3 tests/benchmark/measure.py "${options[@]}" --build "$build" --results "$results" --page "$page/benchmark.md"
/usr/bin/python3 tests/benchmark/starts.py ${quick:+--quick} --build "$build" --results "$results" --page "$page/starts.md"
/usr/bin/python3 tests/benchmark/curves.py ${quick:+--quick} --build "$build" --results "$results" --page "$page/curves.md"
/usr/bin/python3 tests/benchmark/laws.py ${quick:+--quick} --build "$build" --results "$results" --page "$page/laws.md"
