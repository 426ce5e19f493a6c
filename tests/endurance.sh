#!/usr/bin/env bash
# What takes too long for every commit: faults by the hundred, two hosts, a scheduler, another MPI, memory checks.
#   tests/endurance.sh             every part; writes what happened into the table in tests/README.md
#   tests/endurance.sh PART...     only these parts; the table keeps the rows of the others
#   tests/endurance.sh --list      the parts
#   PETERKA_BINARY=.../peterka tests/endurance.sh ...   with this program, instead of building one into build/
#
# A part is an executable file in tests/endurance/. It ends with 0 if all went as it should, and with 77 and a reason if
# this machine lacks what it needs. For each fault it adds a line "fault | how often tried | what happened" to the file
# $ENDURANCE_ROWS. A part that ends otherwise gets a line that says so.
set -euo pipefail
. "$(dirname "$0")/../jobs/arguments.sh"
read_arguments --list 1000 "$@"
cd "$(dirname "$0")/.."

parts=()
for file in tests/endurance/*; do
    [ ! -f "$file" ] || [ ! -x "$file" ] || parts+=("$(basename "${file%.*}")")
done
if has_option --list; then printf '%s\n' "${parts[@]}"; exit; fi
for part in "${words[@]}"; do
    [[ " ${parts[*]} " == *" $part "* ]] || refuse "there is no part $part (--list tells them)"
done
[ ${#words[@]} = 0 ] || parts=("${words[@]}")
[ -z "${PETERKA_BINARY:-}" ] || PETERKA_BINARY=$(program_argument PETERKA_BINARY)

if [ -z "${PETERKA_BINARY:-}" ]; then
    jobs/prepare.sh
    PETERKA_BINARY=$PWD/build/peterka
fi
export PETERKA_BINARY PYTHONDONTWRITEBYTECODE=1
. jobs/mpi_environment.sh

failed=()
for part in "${parts[@]}"; do
    program=$(find tests/endurance -maxdepth 1 -name "$part.*" -perm -u+x)
    echo "== $part"
    ENDURANCE_ROWS=$(mktemp)
    export ENDURANCE_ROWS
    code=0
    "$program" </dev/null || code=$?
    if [ $code != 0 ] && [ $code != 77 ]; then
        failed+=("$part")
        echo "the whole part | 1 | **failed with code $code**" >>"$ENDURANCE_ROWS"
    fi
    [ ! -s "$ENDURANCE_ROWS" ] || /usr/bin/python3 tests/endurance/table.py tests/README.md "$part" "$ENDURANCE_ROWS"
    rm -f "$ENDURANCE_ROWS"
done
[ ${#failed[@]} = 0 ] || { echo "endurance.sh: not as it should be: ${failed[*]}" >&2; exit 1; }
