#!/bin/sh
# slurm.sh N OUT.json [BENCH OPTION...]: measures a sweep in N shards as a Slurm array, the last one, which times the host, on a
# node of its own; merges them into OUT.json and waits for it. Options of sbatch itself (partition, account, time) come from its
# SBATCH_... variables. GLSUM names the program, when it is not to be built first; all nodes must see it, and OUT.json's folder.
set -eu
count=${1:-} out=${2:-}
case $count in '' | *[!0-9]* | 0*) echo "slurm.sh: expected N OUT.json [BENCH OPTION...], found '$count' as N" >&2; exit 2 ;; esac
[ -n "$out" ] || { echo "slurm.sh: expected N OUT.json [BENCH OPTION...], found no OUT.json" >&2; exit 2; }
shift 2
command -v sbatch >/dev/null || { echo "slurm.sh: sbatch: not found (Debian package slurm-client)" >&2; exit 3; }
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
if [ -z "${GLSUM:-}" ]; then
    for command in bench merge; do "$here/../../glsum" $command --no-run; done
    GLSUM=$here/../../build/host/cli/glsum
fi
export GLSUM

mkdir -p "$out.shards"
folder=$(CDPATH='' cd -- "$out.shards" && pwd)
submit() { sbatch --parsable --output "$folder/%x-%A-%a.log" "$@"; }
after=afterok
if [ "$count" -gt 1 ]; then
    after=$after:$(submit --array "1-$((count - 1))" "$here/slurm.sbatch" "$count" "$folder" "$@")
fi
after=$after:$(submit --array "$count" --exclusive "$here/slurm.sbatch" "$count" "$folder" "$@")
# --kill-on-invalid-dep: a shard that failed ends the merge, not an endless wait. That sbatch then reports as success: the mark
# that the merge leaves decides.
rm -f "$folder/merged"
submit --job-name glsum-merge --wait --kill-on-invalid-dep yes --dependency "$after" \
    --wrap "'$GLSUM' merge '$folder'/*-of-'$count'.json --out '${folder%.shards}' && touch '$folder/merged'" >/dev/null || true
[ -e "$folder/merged" ] || { echo "slurm.sh: a shard or the merge failed; the logs are in $folder" >&2; exit 1; }
rm -r "$folder"
