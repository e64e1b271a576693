#!/usr/bin/env bash
# A Slurm on this machine alone, for tests: controller and nodes on loopback, without systemd, cgroups or accounting. Needs root.
#
#   slurm_local.sh start DIR [NODES [CPUS]]   starts munged, slurmctld and NODES slurmd (2) of CPUS each (1); waits until all are idle
#   slurm_local.sh stop DIR                   ends them, by the process ids in DIR
#   slurm_local.sh node DIR K                 starts node K again
#   slurm_local.sh controller DIR             starts the controller again
#
# Then: export SLURM_CONF=DIR/slurm.conf. Ports are chosen by DIR, so that two of these may run beside each other.
set -eu
fail() { echo "slurm_local.sh: $*" >&2; exit 1; }
action=${1:-} dir=$(realpath -m "${2:-/nonexistent/}") nodes=${3:-2} cpus=${4:-1}
export SLURM_CONF=$dir/slurm.conf

write_configuration() {
  local host port
  host=$(hostname -s)
  port=$((20000 + 16#$(echo "$dir" | md5sum | head -c 4) % 500 * 20))
  # AuthInfo: a task that is put back waits until its credential expires, two minutes unless said otherwise.
  # RequeueExit: what `arcus tile` ends with where it can simply be run again. SlurmdTimeout: a node is lost after so many seconds.

  cat >"$SLURM_CONF" <<CONF
ClusterName=arcus
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/sock/munge,cred_expire=5
CredType=cred/munge
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=2
SwitchType=switch/none
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool/%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd-%n.pid
SlurmctldLogFile=$dir/log/slurmctld.log
SlurmdLogFile=$dir/log/slurmd-%n.log
ReturnToService=2
JobRequeue=1
${REQUEUE_EXIT-RequeueExit=75}
SlurmdTimeout=10
KillWait=2
SlurmdParameters=config_overrides
NodeName=n[1-$nodes] NodeHostname=$host NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + nodes))] CPUs=$cpus State=UNKNOWN
PartitionName=tiles Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
}

start() {
  [ "$(id -u)" -eq 0 ] || fail "only root can start slurmd"
  local name
  for name in munged slurmctld slurmd; do command -v "$name" >/dev/null || fail "$name is not there; install slurmctld, slurmd, slurm-client and munge"; done
  mkdir -p "$dir"/{munge,sock,state,spool,log}
  chmod 755 "$dir" "$dir/sock"
  chmod 700 "$dir/munge"
  [ -f "$dir/munge/key" ] || (umask 077; head -c 128 /dev/urandom >"$dir/munge/key")
  chmod 400 "$dir/munge/key"
  munged --force --key-file="$dir/munge/key" --socket="$dir/sock/munge" --pid-file="$dir/sock/pid" --log-file="$dir/munge/log" \
    --seed-file="$dir/munge/seed" --num-threads=1
  write_configuration
  slurmctld
  local k
  for k in $(seq "$nodes"); do start_node "$k"; done
  for _ in $(seq 300); do
    [ "$(sinfo -h -N -t idle -o %N 2>/dev/null | wc -l)" -ge "$nodes" ] && return
    sleep 0.1
  done
  sinfo -N >&2 || :
  tail -n 5 "$dir"/log/*.log >&2 || :
  fail "the nodes are not idle after 30 s"
}

start_node() {
  mkdir -p "$dir/spool/n$1"
  slurmd -N "n$1"
}

stop() {
  local file
  for file in "$dir"/slurmd-*.pid "$dir/slurmctld.pid" "$dir/sock/pid"; do
    if [ -f "$file" ]; then kill "$(cat "$file")" 2>/dev/null || :; fi
  done
}

case $action in
start) start ;;
stop) stop ;;
node) start_node "$3" ;;
controller) slurmctld ;;
*) fail "start, stop, node or controller expected" ;;
esac
