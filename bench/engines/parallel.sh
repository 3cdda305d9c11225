#!/bin/sh
# parallel.sh N OUT.json [BENCH OPTION...]: measures a sweep in N shards by GNU parallel, one a core, the last one, which times the
# host, alone; then merges them into OUT.json. GLSUM names the program, when it is not to be built first.
set -eu
count=${1:-} out=${2:-}
case $count in '' | *[!0-9]* | 0*) echo "parallel.sh: expected N OUT.json [BENCH OPTION...], found '$count' as N" >&2; exit 2 ;; esac
[ -n "$out" ] || { echo "parallel.sh: expected N OUT.json [BENCH OPTION...], found no OUT.json" >&2; exit 2; }
shift 2
# moreutils has a program of this name too.
parallel --version 2>/dev/null | grep -q '^GNU parallel' || { echo "parallel.sh: GNU parallel: not found (Debian package parallel)" >&2; exit 3; }
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
if [ -z "${GLSUM:-}" ]; then
    for command in bench merge; do "$root/glsum" $command --no-run; done
    GLSUM=$root/build/host/cli/glsum
fi
export GLSUM

folder=$out.shards
mkdir -p "$folder"
# Shards appear whole or not at all: those that are there are done.
todo=''
for index in $(seq $((count - 1))); do
    [ -e "$folder/$index-of-$count.json" ] || todo="$todo $index"
done
# --quote: the options' words reach the program as they are.
[ -z "$todo" ] || parallel --will-cite --quote --halt soon,fail=1 --jobs "$(nproc)" "$GLSUM" bench --shard "{}/$count" --jobs 1 --out "$folder/{}-of-$count.json" "$@" ::: $todo
[ -e "$folder/$count-of-$count.json" ] || "$GLSUM" bench --shard "$count/$count" --out "$folder/$count-of-$count.json" "$@"
"$GLSUM" merge "$folder"/*-of-"$count".json --out "$out"
rm -r "$folder"
