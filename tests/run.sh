#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests of every commit: C++ units, MPI tests, the program under mpirun, the
# pictures, the page. Safe to repeat. tests/style.sh has formatting and static analysis.
#   tests/run.sh                  everything
#   tests/run.sh -R PATTERN       only the tests whose name matches
#   tests/run.sh --rerun-failed   only those that failed the last time
set -euo pipefail
. "$(dirname "$0")/../jobs/arguments.sh"
read_arguments "-R --rerun-failed" 1 "$@"
! has_option -R || [ ${#words[@]} = 1 ] || refuse "-R wants a pattern"
has_option -R || [ ${#words[@]} = 0 ] || refuse "${words[0]} follows no -R"
cd "$(dirname "$0")/.."

# The page of explore.py: what builds its engine, and a browser.
# shellcheck disable=SC2046
jobs/prepare.sh $(cat src/page/packages.txt) chromium chromium-driver python3-selenium
. jobs/mpi_environment.sh
ctest --test-dir build --output-on-failure --no-tests=error -j "$(nproc)" "$@"
