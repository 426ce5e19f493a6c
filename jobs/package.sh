#!/usr/bin/env bash
# Makes a Debian package of the program, its Python package, jobs, manual and the page's engine, for the release on which it runs.
#   jobs/package.sh [FOLDER]     into FOLDER (default: packages); apt install ./packages/peterka_*.deb brings what it needs
set -euo pipefail
. "$(dirname "$0")/arguments.sh"
read_arguments "" 1 "$@"
packages=$(folder_argument "${words[0]:-packages}")
cd "$(dirname "$0")/.."

# shellcheck disable=SC2046
jobs/prepare.sh --packages dpkg-dev file $(src/page/packages.sh)
configure build/package -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DCMAKE_UNITY_BUILD=ON -DCMAKE_INSTALL_PREFIX=/usr \
    -DPETERKA_PYTHON_DIR=lib/python3/dist-packages
cmake --build build/package
cpack --config build/package/CPackConfig.cmake -B "$packages"
rm -rf "$packages/_CPack_Packages"
