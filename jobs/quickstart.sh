#!/usr/bin/env bash
# From a fresh clone to a coloured Peterka map: installs what is missing, builds, computes the map of the paper's
# 170 mm rig on 2 ranks, and draws it. Safe to repeat: what is done already is not done again.
#   jobs/quickstart.sh [JOB.toml]           default: jobs/peterka_170mm.toml
set -euo pipefail
. "$(dirname "$0")/arguments.sh"
read_arguments "" 1 "$@"
job=${words[0]:-$(dirname "$0")/peterka_170mm.toml}
[ -f "$job" ] && [ -r "$job" ] || refuse "there is no job file $job"
job=$(realpath "$job")
cd "$(dirname "$0")/.."

jobs/prepare.sh --program
. jobs/mpi_environment.sh

map=$(basename "$job" .toml).h5
mpirun -n 2 build/peterka run "$job" --output "$map" </dev/null
/usr/bin/python3 postprocess/draw.py "$map" --output-dir pictures
echo
echo "The map is $PWD/$map, the pictures are in $PWD/pictures:"
ls pictures/"${map%.h5}"*
