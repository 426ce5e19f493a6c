# Two hosts on this machine: network namespaces with a cable between them, each with a host name of its own. To be
# sourced; needs root. on_host N COMMAND... runs a command there, mpirun_on_both ... starts from host 1 and
# gives up after $patience seconds.
patience=300

host_name() { echo "peterka-$1"; }

make_hosts() {
    local n
    ip link add "$(host_name 1)" type veth peer name "$(host_name 2)"
    for n in 1 2; do
        ip netns add "$(host_name $n)"
        ip link set "$(host_name $n)" netns "$(host_name $n)"
        ip -n "$(host_name $n)" addr add "10.77.0.$n/24" dev "$(host_name $n)"
        ip -n "$(host_name $n)" link set "$(host_name $n)" up
        ip -n "$(host_name $n)" link set lo up
    done
    # What mpirun starts instead of ssh, with the address and a command line as arguments.
    cat >"$1/agent" <<'AGENT'
#!/bin/sh
address=$1
shift
exec ip netns exec "peterka-${address##*.}" unshare --uts sh -c "hostname peterka-${address##*.}; $*"
AGENT
    chmod +x "$1/agent"
    export OMPI_MCA_plm=rsh OMPI_MCA_plm_rsh_agent=$1/agent
}

on_host() {
    local name
    name=$(host_name "$1")
    shift
    ip netns exec "$name" unshare --uts sh -c "hostname $name; exec \"\$@\"" sh "$@"
}

mpirun_on_both() {
    on_host 1 timeout --kill-after=10 "$patience" mpirun --host 10.77.0.1:2,10.77.0.2:2 -n 4 --bind-to none "$@"
}

kill_all_on_host() {
    ip netns pids "$(host_name "$1")" | xargs -r kill -9
}

remove_hosts() {
    local n
    for n in 1 2; do
        kill_all_on_host $n 2>/dev/null || true
        ip netns del "$(host_name $n)" 2>/dev/null || true
    done
}
