#!/usr/bin/env bash
# Puts small faults into the code and tells which of them the tests come upon; writes what became of them into the table in
# tests/README.md. Not part of each commit: of 300 faults, most are caught within minutes once they are built, but one that
# survives takes minutes of its own.
#   tests/mutation.sh COUNT SEED [FOLDER...]   so many, of these folders of src or of all; SEED: a whole number, which draws them
#   tests/mutation.sh --python COUNT SEED      the same in postprocess/peterka
# All faults are in one build, in build/mutation. Repeated, it goes on: what was caught is not tried again.
set -euo pipefail
. "$(dirname "$0")/../jobs/arguments.sh"
read_arguments "--python" 1000 "$@"
[ ${#words[@]} -ge 2 ] && [[ ${words[0]} =~ ^[0-9]+$ && ${words[1]} =~ ^[0-9]+$ ]] || refuse "COUNT and SEED are needed, both whole numbers"
cd "$(dirname "$0")/.."
jobs/prepare.sh --packages libgtest-dev
. jobs/mpi_environment.sh
mkdir -p build/mutation
if has_option --python; then
    [ ${#words[@]} -eq 2 ] || refuse "--python takes COUNT and SEED alone"
    exec python3 tests/mutation/try_python_mutants.py build/mutation "${words[@]}"
fi
exec python3 tests/mutation/try_mutants.py build/mutation "${words[@]}"
