#!/usr/bin/env bash
# Two hosts with a cable between them (network namespaces): the same file as on one; the second host's processes are killed;
# the cable is pulled.
set -euo pipefail
. "$(dirname "$0")/../../jobs/arguments.sh"
start_as_part "$@"
. tests/endurance/two_hosts.sh

row() { echo "$1: $3"; echo "$1 | $2 | $3" >>"$ENDURANCE_ROWS"; }
same() { /usr/bin/python3 tests/endurance/same_map.py "$folder/map.h5" "$folder/whole.h5"; }
job=(run jobs/smoke.toml --set axes.frequency_ratio.points=256 --set axes.gap_ratio.points=256)

ip netns add peterka-probe 2>/dev/null && ip netns del peterka-probe ||
    { echo "skipped: network namespaces need root and the package iproute2"; exit 77; }
folder=$(mktemp -d)
trap 'remove_hosts; rm -rf "$folder"' EXIT
remove_hosts
make_hosts "$folder"

mpirun -n 2 "$PETERKA_BINARY" "${job[@]}" --quiet --output "$folder/whole.h5"
mpirun_on_both "$PETERKA_BINARY" "${job[@]}" --quiet --output "$folder/map.h5"
same
row "two hosts, 2 ranks on each, over TCP" 1 "the same bytes as on one host"

# Starts the run, waits for its first cells, lets COMMAND break it, and tells how many seconds mpirun needs to end.
broken_by() {
    rm -f "$folder/map.h5"
    mpirun_on_both "$PETERKA_BINARY" "${job[@]}" --output "$folder/map.h5" >"$folder/log" 2>&1 &
    local begin=$SECONDS code=0
    until grep -q "cells to compute" "$folder/log"; do
        [ $((SECONDS - begin)) -lt 60 ] || { echo "the run doesn't begin:" >&2; cat "$folder/log" >&2; return 1; }
        sleep 0.1
    done
    begin=$SECONDS
    "$@"
    wait $! || code=$?
    seconds=$((SECONDS - begin))
    [ $code != 0 ] || { echo "the run was over before it could be broken" >&2; return 1; }
    [ $seconds -lt "$patience" ] || { echo "the broken run hangs" >&2; return 1; }
}

for try in 1 2 3; do
    broken_by kill_all_on_host 2
    mpirun -n 3 "$PETERKA_BINARY" "${job[@]}" --quiet --output "$folder/map.h5"
    same
    slowest=$((seconds > ${slowest:-0} ? seconds : ${slowest:-0}))
done
row "all processes of the second host killed" 3 "the run ends within $slowest s; resumed on one host: the same bytes"

export OMPI_MCA_oob_tcp_keepalive_time=5 OMPI_MCA_oob_tcp_keepalive_intvl=1 OMPI_MCA_oob_tcp_keepalive_probes=5
broken_by timeout 1 ip -n "$(host_name 2)" link set "$(host_name 2)" down
mpirun -n 3 "$PETERKA_BINARY" "${job[@]}" --quiet --output "$folder/map.h5"
same
row "the cable between two hosts pulled" 1 "nobody is told; mpirun notices by TCP keepalive, after $seconds s with \
\`OMPI_MCA_oob_tcp_keepalive_time=5 _intvl=1 _probes=5\` (its default is 480 s); resumed on one host: the same bytes"
