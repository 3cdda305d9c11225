#!/bin/sh
# host_time.sh [--gates N] [--other PROGRAM] [--folder DIR]: how often the gate's host time raises an alarm, by real runs of
# five kernels, 3 s of timing each on an idle machine, longer on a busy one.
#   without --other   nothing has changed: each of N+1 recordings is gated against the one before, and against the first
#   --other PROGRAM   a build that is slower somewhere: N recordings of it, each gated against one of this build
# The recordings stay in DIR (default build/gate); a run that was stopped goes on where it was. Prints the alarms, row by row.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
program=$root/build/host/cli/glsum
gates=200
other=
folder=$root/build/gate
while [ $# -gt 0 ]; do
    case $1 in
        --gates) gates=$2; shift 2 ;;
        --other) other=$2; shift 2 ;;
        --folder) folder=$2; shift 2 ;;
        *) echo "host_time.sh: expected --gates N, --other PROGRAM or --folder DIR, found $1" >&2; exit 2 ;;
    esac
done
mkdir -p "$folder"

# record PROGRAM NAME
record() {
    [ -s "$folder/$2.json" ] && return
    "$1" bench --quick --targets host --orders 0.5 --taps 600 --signals step --repetitions 100 --out "$folder/$2.json" \
        --kernels ring_plain_f32,ring_horner_f32,mirror_multi_f32,mirror_simd_f32,ring_plain_q31,peer_std_f32 >"$folder/log" 2>&1 ||
        { cat "$folder/log" >&2; exit 1; }
    rm -f "$folder/$2.csv" "$folder/$2.svg" "$folder/$2.png"
}

# gate BASELINE CURRENT: counts the alarms
gate() {
    trials=$((trials + 1))
    status=0
    "$program" gate --baseline "$folder/$1.json" --current "$folder/$2.json" --thresholds "$root/results/thresholds.toml" \
        >"$folder/said" 2>&1 || status=$?
    case $status in
        0) ;;
        1) alarms=$((alarms + 1)); sed -n "s|^  host_time  *\(gl/.*% .*\)|  $2: \1|p" "$folder/said" ;;
        *) cat "$folder/said" >&2; exit 1 ;;
    esac
}

trials=0 alarms=0
if [ -n "$other" ]; then
    i=0
    while [ $i -lt "$gates" ]; do
        record "$program" "run$i"
        record "$other" "other$i"
        gate "run$i" "other$i"
        i=$((i + 1))
    done
    echo "$alarms of $trials gates of the other build raise an alarm"
    exit 0
fi
record "$program" run0
i=1
while [ $i -le "$gates" ]; do
    record "$program" "run$i"
    gate "run$((i - 1))" "run$i"
    i=$((i + 1))
done
echo "$alarms of $trials gates against the run before raise an alarm; nothing has changed"
trials=0 alarms=0
i=1
while [ $i -le "$gates" ]; do
    gate run0 "run$i"
    i=$((i + 1))
done
echo "$alarms of $trials gates against the first run raise an alarm; nothing has changed"
