#!/usr/bin/env bash
# The same tests under MPICH instead of Open MPI, in a build tree of their own.
set -euo pipefail
. "$(dirname "$0")/../../jobs/arguments.sh"
start_as_part "$@"

for program in mpicc.mpich mpiexec.mpich h5pcc.mpich; do
    command -v $program >/dev/null ||
        { echo "skipped: $program is missing (Debian: mpich, libmpich-dev, libhdf5-mpich-dev)"; exit 77; }
done
configure build/mpich -G Ninja -DCMAKE_BUILD_TYPE=Release -DMPI_C_COMPILER=mpicc.mpich \
    -DMPIEXEC_EXECUTABLE="$(command -v mpiexec.mpich)" -DHDF5_C_COMPILER_EXECUTABLE="$(command -v h5pcc.mpich)"
cmake --build build/mpich
bin=$(mktemp -d)  # where scripts find the mpirun that belongs to it
trap 'rm -rf "$bin"' EXIT
printf '#!/bin/sh\nexec mpiexec.mpich "$@"\n' >"$bin/mpirun"
chmod +x "$bin/mpirun"
code=0
PATH=$bin:$PATH ctest --test-dir build/mpich --output-on-failure -j "$(nproc)" | tee build/mpich/tests.log || code=$?
result=$(grep 'tests passed' build/mpich/tests.log)
echo "the tests under $(mpiexec.mpich --version | grep Version: | xargs | sed 's/Version:/MPICH/') | 1 | $result" \
    >>"$ENDURANCE_ROWS"
exit $code
