#!/usr/bin/env bash
# Runs the jobs of jobs/peers, which repeat what others have published, and writes the page peers.md with what agrees.
#   jobs/peers.sh [FOLDER]     into FOLDER (default: postprocess/examples); half a minute on 2 cores
# Uses the program PETERKA_BINARY (default: build/peterka).
set -euo pipefail
. "$(dirname "$0")/arguments.sh"
read_arguments "" 1 "$@"
folder=$(folder_argument "${words[0]:-$(dirname "$0")/../postprocess/examples}")
[ -z "${PETERKA_BINARY:-}" ] || PETERKA_BINARY=$(program_argument PETERKA_BINARY)
cd "$(dirname "$0")/.."

[ -n "${PETERKA_BINARY:-}" ] || jobs/prepare.sh --program
. jobs/mpi_environment.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for job in jobs/peers/*.toml; do
    mpirun -n 2 "${PETERKA_BINARY:-build/peterka}" run "$job" --quiet --output "$work/$(basename "$job" .toml).h5" </dev/null
done
/usr/bin/python3 jobs/peers/claims.py "$work" "$folder/peers.md"
echo "$folder/peers.md"
