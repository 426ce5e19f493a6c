#!/usr/bin/env bash
# Installs what is missing and builds peterka into build/, with its tests. Safe to repeat. Used by the other scripts.
#   jobs/prepare.sh [--program | --packages] [EXTRA_PACKAGE...]     on Debian 12 or 13, as root or with sudo
#   --program    the program alone, without its tests
#   --packages   installs, and builds nothing
set -euo pipefail
. "$(dirname "$0")/arguments.sh"
read_arguments "--program --packages" 1000 "$@"
for package in "${words[@]}"; do
    [[ $package =~ ^[a-z0-9][a-z0-9.+-]+$ ]] || refuse "$package is no name of a package"
done
cd "$(dirname "$0")/.."

packages=(g++ cmake ninja-build git
    libopenmpi-dev openmpi-bin libhdf5-openmpi-dev libsundials-dev libeigen3-dev libfmt-dev libxxhash-dev
    libcli11-dev libtomlplusplus-dev libhwy-dev
    python3 python3-numpy python3-h5py python3-xarray python3-h5netcdf python3-matplotlib python3-contourpy python3-scipy python3-xxhash
    "${words[@]}")
tests=OFF
has_option --program || { tests=ON packages+=(libgtest-dev python3-netcdf4 python3-pip python3-pytest python3-setuptools); }

# Arb is part of FLINT from Debian 13 on.
release=$(. /etc/os-release 2>/dev/null && echo "${VERSION_ID:-}")
if [ "$release" = 12 ]; then packages+=(libflint-arb-dev); else packages+=(libflint-dev); fi

missing=()
for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
    if ! command -v apt-get >/dev/null; then
        echo "prepare.sh installs packages with apt-get, which is not here. Install these by other means: ${missing[*]}" >&2
        exit 1
    fi
    as_root=()
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null || { echo "Installing ${missing[*]} needs root or sudo." >&2; exit 1; }
        as_root=(sudo)
    fi
    echo "Installing ${#missing[@]} packages: ${missing[*]}"
    "${as_root[@]}" apt-get update -qq
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        -o DPkg::Lock::Timeout=300 "${missing[@]}" >/dev/null
fi

! has_option --packages || exit 0
# A folder of sources as one unit takes half the time from scratch. Who changes the code compiles file by file, after one
# `cmake -B build -DCMAKE_UNITY_BUILD=OFF`, which stays as it is.
unity=ON
! grep -qs '^CMAKE_UNITY_BUILD:[A-Z]*=OFF$' build/CMakeCache.txt || unity=OFF
# Warnings end the build of who changes the code, PETERKA_WARNINGS_AS_ERRORS=ON, and not that of who has a newer compiler.
configure build -G Ninja -DPETERKA_WARNINGS_AS_ERRORS="${PETERKA_WARNINGS_AS_ERRORS:-OFF}" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=$tests \
    -DCMAKE_UNITY_BUILD=$unity -DPETERKA_UNITY_TESTS=ON
cmake --build build
