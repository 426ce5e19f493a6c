#!/usr/bin/env bash
# How much error each engine makes for how much time, where each breaks, and what `auto` leaves out of the paper's maps:
# builds what is needed, runs the studies and the three maps on 2 ranks, draws them, and writes the results page with
# its pictures. Safe to repeat: what is computed already is not computed again.
#   jobs/results.sh [RESULTS_FOLDER [PAGE_FOLDER]]     default: results, postprocess/examples
#   PETERKA_BINARY=... jobs/results.sh                 with a program that is built already
set -euo pipefail
. "$(dirname "$0")/arguments.sh"
read_arguments "" 2 "$@"
results=$(folder_argument "${words[0]:-$(dirname "$0")/../results}")
page=$(folder_argument "${words[1]:-$(dirname "$0")/../postprocess/examples}")
program=$(realpath -m "$(dirname "$0")/../build/peterka")
[ -z "${PETERKA_BINARY:-}" ] || program=$(program_argument PETERKA_BINARY)
cd "$(dirname "$0")/.."

[ -n "${PETERKA_BINARY:-}" ] || jobs/prepare.sh --program
. jobs/mpi_environment.sh

files=()
compute() { # JOB
    local file="$results/$1.h5"
    mpirun -n 2 "$program" run "jobs/$1.toml" --output "$file" </dev/null
    files+=("$file")
}
compute study_work_precision
compute study_cubic_work_precision
compute study_labels
compute study_stability
for rig in 170 150 135; do
    compute "peterka_${rig}mm" # audits itself
done

/usr/bin/python3 postprocess/draw.py "${files[@]}" --output-dir "$results/pictures"
/usr/bin/python3 postprocess/results.py "${files[@]}" --page "$page/results.md" --pictures "$results/pictures"
echo
echo "The files are in $results, their pictures in $results/pictures, the results page is $page/results.md."
