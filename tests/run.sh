#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests of every commit: C++ units, MPI tests, the program under mpirun, the pictures,
# formatting and static analysis. Safe to repeat.
#   tests/run.sh              everything
#   tests/run.sh -R pattern   only the tests whose name matches, no analysis (arguments go to ctest)
set -euo pipefail
cd "$(dirname "$0")/.."

jobs/prepare.sh clang-format clang-tidy
. jobs/mpi_environment.sh
ctest --test-dir build --output-on-failure -j "$(nproc)" "$@"
[ $# = 0 ] || exit 0

tests/style.sh
