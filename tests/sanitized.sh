#!/usr/bin/env bash
# Builds the library and its tests with clang++, AddressSanitizer and UBSan into build/sanitized, warnings as errors, and
# runs the unit and MPI tests in it: any bad memory access, leak or undefined operation fails.
#   tests/sanitized.sh               needs clang++, libclang-rt-dev and libomp-dev
#   tests/sanitized.sh --configure   only makes the tree, for the fuzzer
set -euo pipefail
. "$(dirname "$0")/../jobs/arguments.sh"
read_arguments --configure 0 "$@"
cd "$(dirname "$0")/.."

configure build/sanitized -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_CXX_FLAGS_DEBUG="-O1 -gline-tables-only" -DCMAKE_UNITY_BUILD=ON -DPETERKA_SANITIZERS=ON
! has_option --configure || exit 0

. jobs/mpi_environment.sh
cmake --build build/sanitized --target unit_tests mpi_tests
ctest --test-dir build/sanitized --output-on-failure -j "$(nproc)"
