#!/usr/bin/env bash
# Puts small faults into the code, one by one, and tells which of them the unit tests come upon; writes what became of
# them into the table in tests/README.md. Not part of each commit: a fault takes some 10 s of a core.
#   tests/mutation.sh COUNT SEED [FOLDER...]   so many, of these folders of src or of all; SEED: a whole number, which draws them
# Builds unit_tests into build/mutation first, file by file.
set -euo pipefail
. "$(dirname "$0")/../jobs/arguments.sh"
read_arguments "" 1000 "$@"
[ ${#words[@]} -ge 2 ] && [[ ${words[0]} =~ ^[0-9]+$ && ${words[1]} =~ ^[0-9]+$ ]] || refuse "COUNT and SEED are needed, both whole numbers"
cd "$(dirname "$0")/.."
jobs/prepare.sh --packages libgtest-dev

# One instruction set of the kernels is enough.
configure build/mutation -G Ninja -DBUILD_TESTING=ON -DCMAKE_BUILD_TYPE=Debug -DCMAKE_UNITY_BUILD=OFF -DPETERKA_UNITY_TESTS=ON \
    -DCMAKE_CXX_FLAGS_DEBUG="-O1 -DHWY_COMPILE_ONLY_STATIC"
cmake --build build/mutation --target unit_tests
. jobs/mpi_environment.sh
python3 tests/mutation/try_mutants.py build/mutation "${words[@]}"
