#!/usr/bin/env bash
# Formatting and static analysis of the C++ code: clang-format must change nothing, clang-tidy must find nothing.
#   tests/style.sh BUILD_FOLDER [--deep]
#   --deep: with the path-sensitive analyzer too, which takes a quarter longer
set -euo pipefail
build=$(realpath "$1")
checks=(--checks=-clang-analyzer-*)
[ "${2:-}" != --deep ] || checks=()
cd "$(dirname "$0")/.."

mapfile -t files < <(find src tests -name '*.hpp' -o -name '*.cpp' | sort)
clang-format --dry-run --Werror "${files[@]}"

mapfile -t sources < <(find src -name '*.cpp' | sort)
printf '%s\n' "${sources[@]}" | xargs -P "$(nproc)" -n 4 clang-tidy --quiet "${checks[@]}" -p "$build" --extra-arg=-Wno-unknown-warning-option 2>&1 |
    { grep -v -E '^[0-9]+ warnings? generated\.$|^Suppressed ' || true; } | tee "$build/clang-tidy.log"
! grep -q -E '(warning|error):' "$build/clang-tidy.log"
