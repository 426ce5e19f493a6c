#!/usr/bin/env bash
# jobs/slurm/map.sbatch on a real Slurm of two nodes: submitted, signalled before its time limit, requeued by itself, requeued
# by an administrator, requeued because a node fails, finished.
set -euo pipefail
. "$(dirname "$0")/../../jobs/arguments.sh"
start_as_part "$@"
. tests/endurance/cluster.sh

for program in slurmctld slurmd munged; do
    command -v $program >/dev/null || { echo "skipped: $program is missing (Debian: slurm-wlm, munge)"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: the daemons of a Slurm of its own need root"; exit 77; }
folder=$(mktemp -d)
chmod 755 "$folder"
id= # of the job
leave() {
    if [ -n "$id" ]; then
        scancel "$id" || true # what slurmd has started outlives it
        for _ in $(seq 50); do [ -n "$(squeue --noheader --jobs "$id" 2>/dev/null)" ] || break; sleep 0.2; done
    fi
    stop_cluster "$folder"
    wait
    rm -rf "$folder"
}
trap leave EXIT
start_cluster "$folder"

field() { scontrol show job "$id" | grep -o "$1=[^ ]*" | cut -d= -f2; }
until_true() {
    local deadline=$((SECONDS + 300))
    until "$@"; do
        if [ "$(field JobState)" = FAILED ] || [ $SECONDS -gt $deadline ]; then
            echo "waited for '$*'; the job is $(field JobState)" >&2
            cat "$folder/log" >&2
            exit 1
        fi
        sleep 0.2
    done
}
log_has() { [ "$(grep -c "$2" "$folder/log" 2>/dev/null)" = "$1" ]; }
restarted() { [ "$(field Restarts)" = "$1" ] && [ "$(field JobState)" = PENDING ]; }
finished() { [ "$(field JobState)" = COMPLETED ]; }
start_soon() { scontrol update JobId="$id" StartTime=now+10; } # not in 2 minutes; at once, the old credential is revoked

job=("$PWD/jobs/hunt_crossley_170mm.toml" --set axes.frequency_ratio.points=72 --set axes.gap_ratio.points=72) # a minute
export PETERKA=$PETERKA_BINARY
export OMPI_MCA_btl=tcp,self # two nodes on one machine share no memory as far as Open MPI knows
# Two on each node: a third on one ends in MPI_Init where Open MPI 5 meets Slurm 24.11 on 2 cores, in any program.
id=$(sbatch --parsable --ntasks=4 --nodes=2 --ntasks-per-node=2 --time=1 --signal=USR1@30 --output="$folder/log" \
    jobs/slurm/map.sbatch "${job[@]}" --output "$folder/map.h5")

until_true restarted 1
grep "stopped early (signal SIGUSR1)" "$folder/log"
scontrol update JobId="$id" TimeLimit=60
start_soon

until_true log_has 2 "cells to compute"
scontrol requeue "$id"
until_true restarted 2
start_soon

until_true log_has 3 "cells to compute"
scontrol update NodeName=n2 State=DOWN Reason="it fails"
until_true restarted 3
scontrol update NodeName=n2 State=RESUME
start_soon

until_true finished
cat "$folder/log"
mpirun -n 2 "$PETERKA_BINARY" run "${job[@]}" --quiet --output "$folder/whole.h5"
/usr/bin/python3 tests/endurance/same_map.py "$folder/map.h5" "$folder/whole.h5"
for row in "USR1 before a time limit" "\`scontrol requeue\` of a running job" "a node going down"; do
    echo "Slurm $(sinfo --version | cut -d' ' -f2), 2 nodes: $row | 1 | requeued, goes on, finishes with the same bytes" \
        >>"$ENDURANCE_ROWS"
done
