#!/usr/bin/env bash
# A private Slurm on loopback, for tests of `ambrig campaign --engine slurm`; nothing of the machine's own is touched.
#
#   tools/private_slurm.sh start DIR [NODES] [CPUS]   emulated nodes n1..; prints the export line; pids in DIR/pids
#   tools/private_slurm.sh stop DIR                   ends the recorded processes
#   tools/private_slurm.sh controller DIR             starts the controller again after it was killed
#   tools/private_slurm.sh node DIR K                 starts node K again
#
# SLURM_TEST_PORT: first of NODES + 1 ports (default 16800). Packages: tools/setup.sh --tests.
set -eu
action=$1
mkdir -p "$2"
dir=$(cd "$2" && pwd)
export SLURM_CONF=$dir/slurm.conf

run() {  # name, command...: in the background, its pid recorded
  local name=$1
  shift
  "$@" > "$dir/log/$name.out" 2>&1 < /dev/null &
  echo "$name $!" >> "$dir/pids"
}

write_conf() {
  local nodes=$1 cpus=$2 port=${SLURM_TEST_PORT:-16800} host user
  host=$(hostname -s)
  user=$(id -un)
  cat > "$SLURM_CONF" << CONF
ClusterName=private
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$dir/munge/sock,cred_expire=5
CredType=cred/munge
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool/%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd-%n.pid
SlurmctldLogFile=$dir/log/slurmctld.log
SlurmdLogFile=$dir/log/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_interval=2,sched_min_interval=10000
MpiDefault=none
ReturnToService=2
SlurmdTimeout=5
SlurmctldTimeout=10
KillWait=2
BatchStartTimeout=10
JobRequeue=1
SlurmdParameters=config_overrides
CONF
  for k in $(seq "$nodes"); do
    echo "NodeName=n$k NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + k)) CPUs=$cpus Boards=1 SocketsPerBoard=1" \
         "CoresPerSocket=$cpus ThreadsPerCore=1 State=UNKNOWN" >> "$SLURM_CONF"
  done
  echo "PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO" >> "$SLURM_CONF"
}

case $action in
  start)
    nodes=${3:-2}
    cpus=${4:-1}
    mkdir -p "$dir"/munge "$dir"/state "$dir"/log
    chmod 700 "$dir/munge" "$dir/state"
    for k in $(seq "$nodes"); do mkdir -p "$dir/spool/n$k"; done
    (umask 077 && head -c 128 /dev/urandom > "$dir/munge/key")
    : > "$dir/pids"
    write_conf "$nodes" "$cpus"
    run munged munged --foreground --force --key-file="$dir/munge/key" --socket="$dir/munge/sock" \
      --pid-file="$dir/munge/pid" --log-file="$dir/log/munged.log" --seed-file="$dir/munge/seed"
    for _ in $(seq 50); do [ -S "$dir/munge/sock" ] && break; sleep 0.1; done
    run slurmctld slurmctld -D -c
    for k in $(seq "$nodes"); do run "slurmd-n$k" slurmd -D -N "n$k"; done
    for _ in $(seq 300); do
      if [ "$(sinfo -h -N -t idle -o %N 2> /dev/null | wc -l)" = "$nodes" ]; then
        echo "export SLURM_CONF=$SLURM_CONF"
        exit 0
      fi
      sleep 0.1
    done
    echo "private_slurm: did not come up: $(grep -h error "$dir"/log/*.log | head -1), see $dir/log" >&2
    "$0" stop "$dir"
    exit 1 ;;
  controller) run slurmctld slurmctld -D ;;
  node) run "slurmd-n$3" slurmd -D -N "n$3" ;;
  stop)
    [ -e "$dir/pids" ] || exit 0
    timeout 5 scancel --user="$(id -un)" 2> /dev/null || true
    sleep 1
    tac "$dir/pids" | while read -r _ pid; do
      kill -TERM "$pid" 2> /dev/null || continue
      for _ in $(seq 20); do kill -0 "$pid" 2> /dev/null || break; sleep 0.1; done
      kill -KILL "$pid" 2> /dev/null || true
    done ;;
  *) echo "private_slurm: unknown action $action (allowed: start, stop, controller, node)" >&2; exit 2 ;;
esac
