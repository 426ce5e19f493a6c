#!/usr/bin/env bash
# Formatting and static analysis of the C++ code: clang-format must change nothing, clang-tidy must find nothing.
#   tests/style.sh BUILD_FOLDER [--deep]
#   BUILD_FOLDER with CMAKE_UNITY_BUILD: headers are read once per folder of src, four times faster
#   --deep: with the path-sensitive analyzer, too, which looks only at units that aren't merged
set -euo pipefail
build=$(realpath "$1")
checks=(--checks=-clang-analyzer-*)
[ "${2:-}" != --deep ] || checks=()
cd "$(dirname "$0")/.."

mapfile -t files < <(find src tests -name '*.hpp' -o -name '*.cpp' | sort)
clang-format --dry-run --Werror "${files[@]}"

cmake --build "$build" --target peterka_commit >/dev/null  # a header that sources include
sed -n 's/^ *"file": "\(.*\)",\?$/\1/p' "$build/compile_commands.json" | grep -v /tests/ |
    xargs -P "$(nproc)" -n 1 clang-tidy --quiet --config-file=.clang-tidy "${checks[@]}" -p "$build" \
        --extra-arg=-Wno-unknown-warning-option 2>&1 |
    { grep -v -E '^[0-9]+ warnings? generated\.$|^Suppressed ' || true; } | tee "$build/clang-tidy.log"
! grep -q -E '(warning|error):' "$build/clang-tidy.log"
