#!/usr/bin/env bash
# Formatting and static analysis: clang-format must change nothing in the C++ code, clang-tidy must find nothing there, and
# mypy, by its strict rules, nothing in the type hints of postprocess.
# Each folder of src is read as one unit, headers once, so names must be unique in their folder.
# Installs all three where they are missing.
#   tests/style.sh [--deep]
#   --deep: with the path-sensitive analyzer, too, file by file, which takes four times as long
set -euo pipefail
. "$(dirname "$0")/../jobs/arguments.sh"
read_arguments --deep 0 "$@"
cd "$(dirname "$0")/.."
jobs/prepare.sh --packages clang-format clang-tidy mypy
build=build/style unity=ON checks=(--checks=-clang-analyzer-*)
! has_option --deep || { build=build/deep_style unity=OFF checks=(); }

mapfile -t files < <(find src tests -name '*.hpp' -o -name '*.cpp' | sort)
clang-format --dry-run --Werror "${files[@]}"
(cd postprocess && mypy --cache-dir ../build/mypy peterka ./*.py)

configure $build -G Ninja -DBUILD_TESTING=OFF -DCMAKE_UNITY_BUILD=$unity
cmake --build $build --target peterka_commit >/dev/null  # a header that sources include
sed -n 's/^ *"file": "\(.*\)",\?$/\1/p' $build/compile_commands.json |
    xargs -P "$(nproc)" -n 1 clang-tidy --quiet --config-file=.clang-tidy "${checks[@]}" -p $build \
        --extra-arg=-Wno-unknown-warning-option 2>&1 |
    { grep -v -E '^[0-9]+ warnings? generated\.$|^Suppressed ' || true; } | tee $build/clang-tidy.log
! grep -q -E '(warning|error):' $build/clang-tidy.log
