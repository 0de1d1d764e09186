#!/bin/bash
# Starts or stops a Slurm cluster of this machine alone, which listens on the loopback interface. Needs root, and no
# running Slurm: munge, the controller and the node's daemon have their files and sockets in DIR.
# usage: local_slurm.sh up|down DIR
set -u
action=$1 place=$2
export SLURM_CONF=$place/slurm.conf PATH=$PATH:/usr/sbin:/sbin
port=${KDS_SLURM_PORT:-$((20000 + $$ % 10000))}

# Ends a daemon whose process number is in a file, and waits until it is gone.
end_daemon() {
  local id
  id=$(cat "$1" 2>/dev/null) || return 0
  kill "$id" 2>/dev/null
  for _ in {1..100}; do
    kill -0 "$id" 2>/dev/null || return 0
    sleep 0.1
  done
  kill -9 "$id" 2>/dev/null
}

if [ "$action" = down ]; then
  for daemon in slurmd slurmctld munged; do end_daemon "$place/$daemon.id"; done
  exit 0
fi

umask 022
mkdir -p "$place"/{state,spool}
chmod 755 "$place"  # munged refuses a socket that others cannot reach
(umask 077; head -c 64 /dev/urandom >"$place/munge.key")
cat >"$SLURM_CONF" <<CONF
ClusterName=kds
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
AuthInfo=socket=$place/munge.socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MailProg=/bin/true
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
RequeueExit=75
KillWait=5
SlurmdParameters=config_overrides
NodeName=here NodeHostname=localhost NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000
PartitionName=kds Nodes=here Default=YES MaxTime=INFINITE State=UP
CONF

munged --foreground --force --key-file="$place/munge.key" --socket="$place/munge.socket" --pid-file="$place/munged.pid" \
  --seed-file="$place/munge.seed" --log-file="$place/munged.log" >/dev/null 2>&1 &
echo $! >"$place/munged.id"
for _ in {1..100}; do
  [ -S "$place/munge.socket" ] && break
  sleep 0.05
done
slurmctld -D >"$place/slurmctld.log" 2>&1 </dev/null &
echo $! >"$place/slurmctld.id"
slurmd -D -N here >"$place/slurmd.log" 2>&1 </dev/null &
echo $! >"$place/slurmd.id"
for _ in {1..300}; do
  [ "$(sinfo --noheader --format=%T 2>/dev/null)" = idle ] && exit 0
  sleep 0.1
done
tail -n 20 "$place"/*.log >&2
"$0" down "$place"
exit 1
