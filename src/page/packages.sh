#!/usr/bin/env bash
# Names Debian's packages that build_wasm.sh needs: the release's own clang where that is 16 or later, else clang 16.
#   apt-get install $(src/page/packages.sh)
set -euo pipefail
release=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
[ "$release" = bookworm ] && version=-16 || version=
echo "clang$version" "lld$version" "libc++$version-dev-wasm32" "libclang-rt$version-dev-wasm32" libeigen3-dev
