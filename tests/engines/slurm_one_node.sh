#!/bin/sh
# slurm_one_node.sh [GLSUM]: a Slurm of one node, from Debian's packages, in a temporary folder; runs an array of shards there,
# merges them and compares with the unsharded run. Installs what is missing, so it needs root; ends only what it started. On demand.
# GLSUM is the program, by default that of build/host, as built by ./glsum.
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
glsum=${1:-$root/build/host/cli/glsum}
[ "$(id -u)" -eq 0 ] || { echo "slurm_one_node: expected root, found user $(id -un)" >&2; exit 3; }
[ -x "$glsum" ] || { echo "slurm_one_node: $glsum: not found; expected from ./glsum bench --help" >&2; exit 3; }
missing=$(for package in slurmctld slurmd slurm-client munge; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || printf '%s ' "$package"
done)
if [ -n "$missing" ]; then
    echo "slurm_one_node: installing Debian packages: $missing"
    { apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends $missing; } >/dev/null ||
        { echo "slurm_one_node: could not install: $missing" >&2; exit 3; }
fi
. "$(dirname "$0")/same_sweep.sh"
set +f

# Daemons of our own beside any that run here: own key, sockets, ports and state.
started=''
finish() {
    for id in $started; do kill "$id" 2>/dev/null; done
    for id in $started; do
        while kill -0 "$id" 2>/dev/null; do sleep 0.2; done
    done
    rm -rf "$folder"
}
trap finish EXIT
trap 'exit 1' INT TERM
chmod 755 "$folder"
mkdir "$folder/munge" "$folder/controller" "$folder/node"
dd if=/dev/urandom of="$folder/munge/key" bs=128 count=1 status=none
chmod 700 "$folder/munge" && chmod 400 "$folder/munge/key"
chmod 711 "$folder/munge"
host=$(uname -n)
cat >"$folder/slurm.conf" <<CONF
ClusterName=glsum
SlurmctldHost=$host(127.0.0.1)
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
SlurmUser=root
SlurmctldPort=46817
SlurmdPort=46818
SlurmctldPidFile=$folder/controller/pid
SlurmdPidFile=$folder/node/pid
StateSaveLocation=$folder/controller
SlurmdSpoolDir=$folder/node
SlurmctldLogFile=$folder/controller/log
SlurmdLogFile=$folder/node/log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
printf 'CgroupPlugin=cgroup/v1\nCgroupAutomount=no\n' >"$folder/cgroup.conf"
export SLURM_CONF="$folder/slurm.conf"

munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" \
    --seed-file="$folder/munge/seed" --log-file="$folder/munge/log" >"$folder/munge/said" 2>&1 &
started="$!"
sleep 1
slurmctld -D -i >"$folder/controller/said" 2>&1 &
started="$! $started"
slurmd -D -N "$host" >"$folder/node/said" 2>&1 &
started="$! $started"
for try in $(seq 60); do
    [ "$(sinfo --noheader --format %t 2>/dev/null)" = idle ] && break
    sleep 1
done
if [ "$(sinfo --noheader --format %t 2>/dev/null)" != idle ]; then
    echo "slurm_one_node: the node does not come up:" >&2
    tail -n 5 "$folder"/*/said "$folder"/*/log >&2
    exit 1
fi
echo "slurm_one_node: $(sinfo --version), $(sinfo --noheader --format '%D node, %c CPUs')"

GLSUM=$glsum "$root/bench/engines/slurm.sh" 3 "$folder/merged.json" $options >"$folder/engine.txt" 2>&1 ||
    fail "slurm.sh: $(tail -n 5 "$folder/engine.txt" "$folder"/merged.json.shards/*.log)"
compare_with_whole "$glsum"
GLSUM=$glsum "$root/bench/engines/slurm.sh" 2 "$folder/bad.json" --orders 3 >/dev/null 2>&1 && fail "a failing shard was not told"
[ "$failures" -eq 0 ] && echo "slurm_one_node: $(wc -l <"$folder/merged.rows") lines of the merged CSV, equal to the unsharded run's"
