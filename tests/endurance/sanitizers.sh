#!/usr/bin/env bash
# The unit and MPI tests under AddressSanitizer and UBSan, built by clang++ with warnings as errors.
set -euo pipefail
. "$(dirname "$0")/../../jobs/arguments.sh"
start_as_part "$@"
command -v clang++ >/dev/null || { echo "skipped: there is no clang++ (jobs/prepare.sh clang libclang-rt-dev libomp-dev)"; exit 77; }

tests/sanitized.sh
tests=$(build/sanitized/tests/unit_tests --gtest_list_tests | grep -c '^  ')
echo "unit and MPI tests under AddressSanitizer and UBSan | $tests unit tests, MPI tests on 1, 2, 4 ranks | no bad access, leak of ours or undefined operation" >>"$ENDURANCE_ROWS"
