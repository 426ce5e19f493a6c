#!/usr/bin/env bash
# valgrind, with Open MPI's suppressions: runs with each engine, a resumed run, a basin, and the tests on several ranks,
# if they were built: then they lie in tests/ beside the program.
set -euo pipefail
. "$(dirname "$0")/../../jobs/arguments.sh"
start_as_part "$@"
command -v valgrind >/dev/null || { echo "skipped: valgrind is missing"; exit 77; }
suppressions=$(find /usr/share -name openmpi-valgrind.supp | head -n 1)
[ -n "$suppressions" ] || { echo "skipped: Open MPI's openmpi-valgrind.supp is missing"; exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
runs=0
wrong=0
checked() { # code that is expected, program, arguments
    local expected=$1 code=0
    shift
    mpirun -n 2 valgrind -q --error-exitcode=99 --suppressions="$suppressions" \
        --suppressions=tests/endurance/valgrind.supp "$@" || code=$?
    runs=$((runs + 1))
    [ $code = "$expected" ] || { echo "exit code $code, expected $expected: $*" >&2; wrong=$((wrong + 1)); }
}
few=(--set axes.frequency_ratio.points=20 --set axes.gap_ratio.points=20 --quiet)
fewer=(--set axes.frequency_ratio.points=4 --set axes.gap_ratio.points=3 --quiet)

checked 5 "$PETERKA_BINARY" run jobs/smoke.toml "${few[@]}" --output "$folder/map.h5" --max-wall 0.5
checked 0 "$PETERKA_BINARY" run jobs/smoke.toml "${few[@]}" --output "$folder/map.h5"
checked 0 "$PETERKA_BINARY" run jobs/smoke.toml "${few[@]}" --output "$folder/split.h5" --set solver.engine=split \
    --set hammer.cubic_stiffness_n_per_m3=238 --set audit.cells=3
checked 0 "$PETERKA_BINARY" run jobs/smoke.toml "${few[@]}" --output "$folder/refined.h5" --set refine.levels=2
for engine in cvode arkode; do
    checked 0 "$PETERKA_BINARY" run jobs/smoke.toml "${fewer[@]}" --output "$folder/$engine.h5" --set solver.engine=$engine
done
checked 0 "$PETERKA_BINARY" run jobs/basin_150mm_coexisting.toml --set axes.displacement_ratio.points=12 \
    --set axes.velocity_ratio.points=12 --quiet --output "$folder/basin.h5"
checked 0 "$PETERKA_BINARY" run jobs/smoke.toml "${fewer[@]}" --output "$folder/starts.h5" --set starts.count=16 \
    --set 'output.fields=["critical_kick"]'
checked 0 "$PETERKA_BINARY" run jobs/rigid_170mm.toml "${fewer[@]}" --output "$folder/rigid.h5" --set starts.count=8
checked 0 "$PETERKA_BINARY" run jobs/design_stop.toml --quiet --output "$folder/rigs.h5"
checked 0 "$PETERKA_BINARY" run jobs/curves_170mm.toml "${fewer[@]}" --output "$folder/curves.h5"
checked 2 "$PETERKA_BINARY" run jobs/smoke.toml --set hammer.mass_kg=-1
tests=$(dirname "$PETERKA_BINARY")/tests/mpi_tests
of_tests="the MPI tests not tried: they were not built"
if [ -x "$tests" ]; then
    checked 0 "$tests" --gtest_brief=1
    of_tests="the MPI tests"
fi

echo "valgrind on 2 ranks: every engine, resume, refinement, audit, basin, starts with kicks, a rigid stop, rigs of their own, curves, a bad job; $of_tests | $runs | \
$((runs - wrong)) without any error" >>"$ENDURANCE_ROWS"
[ $wrong = 0 ]
