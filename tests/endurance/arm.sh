#!/usr/bin/env bash
# aarch64: Debian 12's cross compiler builds the last commit in a root of its own, and QEMU runs there its unit tests, and
# small jobs whose files are compared with those of $PETERKA_BINARY (close_map.py). QEMU tells nothing of speed.
set -euo pipefail
. "$(dirname "$0")/../../jobs/arguments.sh"
start_as_part "$@"
. tests/releases/roots.sh

root=$folder/bookworm
make_root bookworm "$root"
# SUNDIALS's package wants Fortran and PETSc of arm64, which don't install beside a cross compiler: it is unpacked.
# Open MPI's wrapper of compilers is a program of arm64, which answers through QEMU.
inside "$root" bash -euo pipefail -c '
    export DEBIAN_FRONTEND=noninteractive
    dpkg --add-architecture arm64
    apt-get update -qq
    libraries=(openmpi hdf5-openmpi fmt xxhash tomlplusplus hwy gtest flint-arb)
    libraries=("${libraries[@]/#/lib}")
    apt-get install -y -qq --no-install-recommends g++-aarch64-linux-gnu qemu-user-static cmake ninja-build git python3 \
        libeigen3-dev libcli11-dev "${libraries[@]/%/-dev:arm64}" >/dev/null
    cd "$(mktemp -d)"
    mapfile -t names < <(apt-cache show libsundials-dev:arm64 | grep -o "libsundials-[a-z0-9-]*" | sort -u)
    apt-get download -qq libsundials-dev:arm64 "${names[@]/%/:arm64}"
    for package in *.deb; do dpkg -x "$package" /; done
    mv /usr/bin/opal_wrapper /usr/bin/opal_wrapper.arm64
    {
        echo "#!/bin/sh"
        echo "export OMPI_CC=aarch64-linux-gnu-gcc OMPI_CXX=aarch64-linux-gnu-g++"
        echo "exec qemu-aarch64-static -0 \"\$0\" /usr/bin/opal_wrapper.arm64 \"\$@\""
    } >/usr/bin/opal_wrapper
    chmod +x /usr/bin/opal_wrapper' || cannot "Debian's cross compiler or its libraries of arm64 can't be installed"
inside "$root" cmake -S . -B build -G Ninja -DCMAKE_TOOLCHAIN_FILE=tests/endurance/aarch64.cmake -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_UNITY_BUILD=ON -DPETERKA_UNITY_TESTS=ON -DBUILD_TESTING=ON \
    -DPETERKA_WARNINGS_AS_ERRORS="${PETERKA_WARNINGS_AS_ERRORS:-OFF}" >/dev/null
inside "$root" cmake --build build --target peterka unit_tests

row() { echo "$1: $3"; echo "$1 | $2 | $3" >>"$ENDURANCE_ROWS"; }
wrong=0
emulator="aarch64, $(inside "$root" qemu-aarch64-static --version | sed -n '1s/qemu-aarch64 version \([0-9.]*\).*/QEMU \1/p')"

inside "$root" ctest --test-dir build -R '^unit[.]' --timeout 1800 -j "$(nproc)" | tee "$folder/tests.log" || wrong=1
failed=$(sed -n 's/^\t *[0-9]* - \([^ ]*\) (\(.*\)).*/\1 (\2)/p' "$folder/tests.log" | paste -s -d , | sed 's/,/, /g')
tried=$(sed -n 's/.* tests failed out of \([0-9]*\)$/\1/p' "$folder/tests.log")
row "$emulator: suites of unit tests" "$tried" "${failed:-all pass}"

plane() { echo --set "axes.frequency_ratio.points=$1" --set "axes.gap_ratio.points=$1"; }
compare() { # WHAT RANKS JOB ARGUMENT...
    local what=$1 ranks=$2 found code=0
    shift 2
    rm -f "$folder/here.h5" "$root/there.h5"
    "$PETERKA_BINARY" run "$@" --quiet --output "$folder/here.h5"
    # mpirun is a program of arm64 like its ranks; without it a rank would start another one, orted, and not by QEMU.
    inside "$root" bash -euc '. jobs/mpi_environment.sh; exec "$@"' bash qemu-aarch64-static /usr/bin/mpirun -n "$ranks" \
        qemu-aarch64-static build/peterka run "$@" --quiet --output /there.h5 || code=$?
    if [ $code != 0 ]; then
        found="**exit code $code**"
    else
        found=$(/usr/bin/python3 tests/endurance/close_map.py "$root/there.h5" "$folder/here.h5") || { found="**$found**"; code=1; }
    fi
    [ $code = 0 ] || wrong=1
    row "$emulator: $what, against $(uname -m)" 1 "$found"
}
# shellcheck disable=SC2046
{
    compare "the plane of 170 mm, 48 × 48 cells" 1 jobs/smoke.toml $(plane 48)
    compare "the same on two ranks" 2 jobs/smoke.toml $(plane 48)
    compare "a rigid stop, 24 × 24 cells" 1 jobs/rigid_170mm.toml $(plane 24)
    compare "uncertain rigs, 8 × 8 cells" 1 jobs/uncertain_170mm.toml $(plane 8)
}
compare "a basin, 24 × 24 starts" 1 jobs/basin_150mm_coexisting.toml \
    --set axes.displacement_ratio.points=24 --set axes.velocity_ratio.points=24
[ $wrong = 0 ]
