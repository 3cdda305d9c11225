#!/bin/sh
# speed.sh: CPU seconds, on one thread, of a handful of diagnoses: records of the virtual stand of 40 s at 100 Hz with a second
# one to judge by, some shorter and longer ones, and the real records where GLSUM_SHARED leads to them. Samples are those of
# both. Numbers, no verdict on them.
# GLSUM: the program (build/host/cli/glsum).
set -eu
cd "$(dirname "$0")/.."
glsum=$(realpath "${GLSUM:-build/host/cli/glsum}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

stand() {
    "$glsum" stand --ideal --set noise.deviation=0.003 --set interval_s=0.01 --duty 0.1 "$@" >/dev/null 2>&1
}

# NAME OPTION...: a line with the seconds of user and system time, the verdict, and what is named.
try() {
    name=$1
    shift
    (
        "$glsum" diagnose drive --jobs 1 "$@" >"$folder/said" 2>/dev/null
        times  # its last line is of what ran here; in a pipe it would be of nothing
    ) >"$folder/times" || { printf '%-34s failed\n' "$name"; return 0; }
    seconds=$(tail -n 1 "$folder/times" | sed 's/[ms]/ /g' | awk '{ print 60 * $1 + $2 + 60 * $3 + $4 }')
    printf '%-34s %6.1f s  %s\n' "$name" "$seconds" "$(sed -n 's/^verdict: //p' "$folder/said")"
}

stand --until-s 40 --experiment staircase --seed 1 --out "$folder/plain_t.csv" --model "$folder/m.json"
stand --until-s 40 --experiment prbs --low-duty 0.02 --bit-s 0.5 --seed 2 --out "$folder/plain_v.csv"
for set in backlash.gap=0.05 input_dead_zone.width=0.015; do
    stand --until-s 40 --set $set --experiment staircase --seed 1 --out "$folder/${set%%.*}_t.csv"
    stand --until-s 40 --set $set --experiment prbs --low-duty 0.02 --bit-s 0.5 --seed 2 --out "$folder/${set%%.*}_v.csv"
done

for until in 20 125; do
    stand --until-s $until --set backlash.gap=0.05 --experiment staircase --seed 1 --out "$folder/${until}_t.csv"
    stand --until-s $until --set backlash.gap=0.05 --experiment prbs --low-duty 0.02 --bit-s 0.5 --seed 2 --out "$folder/${until}_v.csv"
done

for kind in plain backlash input_dead_zone; do
    try "$kind, given model" --model "$folder/m.json" --log "$folder/${kind}_t.csv" --validate "$folder/${kind}_v.csv"
done
try "backlash, fit:niopdt" --model fit:niopdt --log "$folder/backlash_t.csv" --validate "$folder/backlash_v.csv"
try "plain, fit:sopdt" --model fit:sopdt --log "$folder/plain_t.csv" --validate "$folder/plain_v.csv"
try "4000 samples, fit" --model fit --log "$folder/20_t.csv" --validate "$folder/20_v.csv"
try "25000 samples, fit" --model fit --log "$folder/125_t.csv" --validate "$folder/125_v.csv"
real=${GLSUM_SHARED:-none}/data/real
if [ -d "$real" ]; then
    try "real: heater, fit" --model fit --domain thermal --log "$real/heater.csv" --split 300
    try "real: tanks, fit" --model fit --domain hydraulic --log "$real/tanks_train.csv" --validate "$real/tanks_validate.csv"
    try "real: carriage, fit" --model fit --domain mechanical --metric prediction --log "$real/carriage_train.csv" \
        --validate "$real/carriage_validate.csv"
    try "real: swing, fit" --model fit --domain mechanical --log "$real/swing_1.csv" --log "$real/swing_2.csv" \
        --validate "$real/swing_3.csv"
fi
