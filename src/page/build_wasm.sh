#!/usr/bin/env bash
# Builds the engine for browsers: WebAssembly by clang, with wasi's C library and nothing of an operating system.
#   src/page/build_wasm.sh OUTPUT.wasm
# Prints the number of its files, then a line for each that is compiled.
# Its packages: apt-get install $(src/page/packages.sh)
# CXX_WASM names another clang. Nothing is fused and no pass may reorder: bits are those of machines without fused
# multiply-add, but for sin, cos and exp, which are those of another C library.
set -euo pipefail
output=$(realpath -m "$1")
cd "$(dirname "$0")/.."

compiler=${CXX_WASM:-$(command -v clang++-16 || echo clang++)}  # 16 where the release's own is older
command -v "$compiler" >/dev/null || { echo "$compiler is not here" >&2; exit 1; }
version=$("$compiler" -dumpversion)
headers=$(realpath -m "$("$compiler" -print-resource-dir)/../../../include/wasm32-wasi/c++/v1")
[ -d "$headers" ] || { echo "libc++ for wasm32 (Debian: libc++-${version%%.*}-dev-wasm32) is not here" >&2; exit 1; }
eigen=${EIGEN3_INCLUDE_DIR:-/usr/include/eigen3}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
flags=(--target=wasm32-wasi -std=c++20 -O2 -flto -DNDEBUG -DEIGEN_NO_DEBUG -ffp-contract=off -fno-exceptions -fno-rtti
    -nostdinc++ -isystem "$headers" -isystem "$eigen" -I.)
# shellcheck disable=SC2046,SC2086
sources=$(ls $(grep -v '^!' engine_sources.txt) page/*.cpp | grep -v -x -F "$(sed -n 's/^!//p' engine_sources.txt)")
echo "$sources" | wc -l
echo "$sources" |
    xargs -P "$(nproc)" -I{} bash -ec 'object=$1/${2//\//_}.o; shift; source=$1; shift; "$@" -c "$source" -o "$object"; echo "$source"' \
        build "$work" {} "$compiler" "${flags[@]}"
mapfile -t exports < <(sed -n 's/^[a-z].*[ *]\(peterka_[a-z_]*\)(.*/-Wl,--export=\1/p' page/interface.hpp)
"$compiler" --target=wasm32-wasi -mexec-model=reactor -O2 -flto -Wl,--lto-O2 -Wl,--strip-all -Wl,-z,stack-size=1048576 \
    "${exports[@]}" "$work"/*.o -o "$work/engine.wasm"
mv "$work/engine.wasm" "$output"  # whole or not at all
