# A Slurm cluster of two nodes on this machine, in a folder of its own: to be sourced, then start_cluster FOLDER.
# Needs slurmctld, slurmd and munged (Debian: slurm-wlm, munge) and root; touches nothing outside FOLDER.

start_munge() {
    mkdir -m 0700 "$1/munge"
    dd if=/dev/urandom of="$1/munge/key" bs=1 count=1024 status=none
    chmod 0400 "$1/munge/key"
    munged --force --key-file="$1/munge/key" --socket="$1/munge/socket" --pid-file="$1/munge/pid" \
        --log-file="$1/munge/log" --seed-file="$1/munge/seed"
}

write_slurm_conf() {
    local host
    host=$(hostname -s)
    cat >"$1/slurm.conf" <<CONF
ClusterName=peterka
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$1/munge/socket
CredType=cred/munge
StateSaveLocation=$1/state
SlurmdSpoolDir=$1/spool.%n
SlurmctldPidFile=$1/slurmctld.pid
SlurmdPidFile=$1/slurmd.%n.pid
SlurmctldLogFile=$1/slurmctld.log
SlurmdLogFile=$1/slurmd.%n.log
SlurmctldPort=17817
SlurmdPort=17818
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SwitchType=switch/none
MpiDefault=pmix
SlurmdParameters=config_overrides
TmpFS=$1/tmp.%n
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
KillWait=5
OverTimeLimit=0
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=17821 CPUs=4 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=17822 CPUs=4 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
}

start_cluster() {
    start_munge "$1"
    mkdir "$1/state" "$1/spool.n1" "$1/spool.n2" "$1/tmp.n1" "$1/tmp.n2"
    write_slurm_conf "$1"
    export SLURM_CONF=$1/slurm.conf
    slurmctld -f "$SLURM_CONF"
    slurmd -f "$SLURM_CONF" -N n1
    slurmd -f "$SLURM_CONF" -N n2
}

stop_cluster() {
    local pid_file
    for pid_file in "$1"/slurmd.n1.pid "$1"/slurmd.n2.pid "$1"/slurmctld.pid "$1"/munge/pid; do
        [ -f "$pid_file" ] || continue
        local pid
        pid=$(cat "$pid_file")
        kill "$pid"
        # slurmctld writes its state at its end, into the folder that goes next
        for _ in $(seq 50); do [ -d "/proc/$pid" ] || break; sleep 0.2; done
    done
}
