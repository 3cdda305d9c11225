#!/bin/sh
# Diagnosing a drive as a person does: logs of the virtual stand against its linear model, the verdict's file, and what does not
# belong together. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"

make() { # NAME EXPERIMENT SEED [OPTION...]
    name=$1 experiment=$2 seed=$3
    shift 3
    "$program" stand --ideal --set noise.deviation=0.003 --set interval_s=0.02 --until-s 20 --duty 0.1 --experiment "$experiment" \
        --seed "$seed" --out "$folder/$name.csv" "$@" 2>"$folder/said" || { cat "$folder/said"; failures=$((failures + 1)); }
}
"$program" stand --ideal --set interval_s=0.02 --experiment step --until-s 1 --model "$folder/linear.json" --out "$folder/any.csv"
make train staircase 1 --set input_dead_zone.width=0.02
make other prbs 2 --set input_dead_zone.width=0.02 --low-duty 0.02 --bit-s 0.5
make clean staircase 3
make cleaner chirp 4

expect 0 "verdict: attributed: input_dead_zone" diagnose drive --model "$folder/linear.json" --log "$folder/train.csv" \
    --validate "$folder/other.csv" --json "$folder/verdict.json" --improved "$folder/improved.json" --html "$folder/page.html"
for field in '"schema": "glsum-gap-1"' '"verdict": "attributed"' '"effect": "input_dead_zone"' '"width": 0.0' '"gap_before"' '"gap_after"' \
    '"shrink"' '"confidence"' '"ranking"' '"score"' '"metric": "simulation"' '"base"' '"after"' '"noise_floor"' '"from_s"' '"from_hz"' \
    '"input_level"' '"output_level"' '"rising"' '"falling"' '"still"' '"next_experiment"'; do
    grep -qF "$field" "$folder/verdict.json" || { echo "verdict.json: expected $field"; failures=$((failures + 1)); }
done
# The shares of each list sum to 1.
for list in time frequency input_level output_level; do
    sum=$(awk -v list="\"$list\": [" 'index($0, list) {on = 1} on && /"share"/ {gsub(/[^-0-9.e]/, "", $2); sum += $2} on && /\]/ {on = 0}
        END {printf "%.6f", sum}' "$folder/verdict.json")
    [ "$sum" = 1.000000 ] || { echo "verdict.json: expected shares of $list that sum to 1, found $sum"; failures=$((failures + 1)); }
done
# The improved model is nearer to the log than the base.
expect 0 "with input_dead_zone" simulate --model "$folder/improved.json" --input "$folder/other.csv" --step-s 0.02 --out "$folder/better.csv"
expect 0 "" simulate --model "$folder/linear.json" --input "$folder/other.csv" --step-s 0.02 --out "$folder/base.csv"
distance() { # of the second file's third column from the measured one, every 20 ms
    awk -F, 'NR == FNR {if (FNR > 2) z[n++] = $3; next} FNR > 1 {d = $3 - z[m++]; s += d * d} END {print sqrt(s / m)}' "$folder/other.csv" "$1"
}
[ "$(echo "$(distance "$folder/better.csv") $(distance "$folder/base.csv")" | awk '{print ($1 < 0.5 * $2)}')" = 1 ] ||
    { echo "improved model: $(distance "$folder/better.csv") from the log, base $(distance "$folder/base.csv")"; failures=$((failures + 1)); }
# So do its indices, which simulate the effects too: less than half of what the base leaves.
fit() { "$program" indices "$folder/other.csv" --model "$1" --json | sed -n 's/.*"nrmse_fit": \([-0-9.e]*\).*/\1/p'; }
[ "$(echo "$(fit "$folder/improved.json") $(fit "$folder/linear.json")" | awk 'NF == 2 {print (1 - $1 < 0.5 * (1 - $2))}')" = 1 ] ||
    { echo "indices: improved $(fit "$folder/improved.json"), base $(fit "$folder/linear.json")"; failures=$((failures + 1)); }
# And what simulate writes of a jittered log is what indices simulates of it: at the log's own stamps, on no grid.
awk -F, -v OFS=, 'FNR > 2 {$1 = sprintf("%.6f", $1 + 0.02 * ((7 * FNR) % 11) / 12)} {print}' "$folder/other.csv" >"$folder/uneven.csv"
expect 0 "with input_dead_zone" simulate --model "$folder/improved.json" --input "$folder/uneven.csv" --out "$folder/own.csv"
expect 0 '' indices "$folder/uneven.csv" --model "$folder/improved.json" --simulated "$folder/own.csv" --json
[ "$(sed -n 's/.*"nrmse_fit": \([-0-9.e]*\).*/\1/p' "$folder/said" | awk '{d[NR] = $1} END {print (NR == 2 && (d[1] - d[2]) ^ 2 < 1e-10)}')" = 1 ] ||
    { echo "simulate: $(grep nrmse_fit "$folder/said" | tr -d '\n')"; failures=$((failures + 1)); }
grep -qF 'input_dead_zone' "$folder/page.html" || { echo "page.html: expected the effect's name"; failures=$((failures + 1)); }
grep -qF "<code>glsum diagnose drive --model $folder/linear.json" "$folder/page.html" || { echo "page.html: expected the command"; failures=$((failures + 1)); }
grep -qF 'polyline class="input"' "$folder/page.html" || { echo "page.html: expected the input's curve"; failures=$((failures + 1)); }
! grep -qE 'https?://[^w]' "$folder/page.html" || { echo "page.html: expected nothing from the network"; failures=$((failures + 1)); }

expect 0 "verdict: no_gap" diagnose drive --model "$folder/linear.json" --log "$folder/clean.csv" --validate "$folder/cleaner.csv"
expect 0 "judged by parts of the training record" diagnose drive --model "$folder/linear.json" --log "$folder/train.csv"
expect 2 "found the training log itself" diagnose drive --model "$folder/linear.json" --log "$folder/train.csv" --validate "$folder/train.csv"
expect 0 "fitting" diagnose drive --model fit:sopdt --log "$folder/clean.csv" --validate "$folder/cleaner.csv"

expect 2 "fit:pid: expected one of fopdt, sopdt" diagnose drive --model fit:pid --log "$folder/clean.csv"
expect 2 "cannot read" diagnose drive --model "$folder/none.json" --log "$folder/clean.csv"
expect 2 "no effect wear" diagnose drive --model "$folder/linear.json" --log "$folder/clean.csv" --without wear
awk -F, 'NR < 3 {print; next} {printf "%s,%s,%.6f\n", $1, $2, 1000 * $3}' "$folder/clean.csv" | sed 's/angle_rad/output/' >"$folder/milli.csv"
expect 2 "expected the model's units" diagnose drive --model "$folder/linear.json" --log "$folder/milli.csv"
awk -F, 'NR < 3 {print; next} {printf "%.6f,%s,%s\n", 1000 * $1, $2, $3}' "$folder/clean.csv" >"$folder/ms.csv"
expect 2 "are the stamps in seconds?" diagnose drive --model "$folder/linear.json" --log "$folder/ms.csv"
sed 's/"delay_s": [0-9.]*/"delay_s": 30/' "$folder/linear.json" >"$folder/late.json"
expect 2 "expected a log longer than the model's dead time of 30 s" diagnose drive --model "$folder/late.json" --log "$folder/clean.csv"
sed '10s/,[^,]*$/,nan/' "$folder/clean.csv" >"$folder/nan.csv"
expect 2 "nan.csv:10: angle_rad: expected a finite number, found 'nan'" diagnose drive --model "$folder/linear.json" --log "$folder/nan.csv"
awk -F, 'NR < 3 {print; next} {printf "%s,0,%s\n", $1, $3}' "$folder/clean.csv" >"$folder/off.csv"
expect 2 "the input is 0 throughout" diagnose drive --model "$folder/linear.json" --log "$folder/off.csv"
# The log of one drive, the model of another: never a confident verdict.
awk -F, 'NR < 3 {print; next} {printf "%s,%s,%.6f\n", $1, $2, 0.3 * sin(1.7 * $1) + 0.2 * sin(5.1 * $1 + 1)}' "$folder/clean.csv" >"$folder/foreign.csv"
expect 0 "do model and log belong together?" diagnose drive --model "$folder/linear.json" --log "$folder/foreign.csv"
# As the launcher calls it, and a whole set, hashed as `score` wants it.
expect 2 "expected drive, cycles, --batch DIR or --exam MANIFEST" diagnose --jobs 2
expect 0 "verdict: no_gap" diagnose --jobs 1 drive --model "$folder/linear.json" --log "$folder/clean.csv" --validate "$folder/cleaner.csv"
for case in 001 002; do
    mkdir -p "$folder/set/$case"
    cp "$folder/linear.json" "$folder/set/$case/model.json"
done
cp "$folder/train.csv" "$folder/set/001/train.csv"
cp "$folder/clean.csv" "$folder/set/002/train.csv"
cp "$folder/cleaner.csv" "$folder/set/002/validate.csv"
cp "$folder/cleaner.csv" "$folder/set/001/validate.csv"
expect 0 "002  no_gap" diagnose --jobs 2 --batch "$folder/set"
(cd "$folder/set" && sha256sum --quiet -c verdicts.sha256) || { echo "expected hashes of the verdicts"; failures=$((failures + 1)); }
[ "$(wc -l <"$folder/set/verdicts.sha256")" -eq 2 ] || { echo "expected two hashes"; failures=$((failures + 1)); }
echo broken >"$folder/set/001/model.json"
expect 2 "1 of 2 cases have no verdict" diagnose --batch "$folder/set"
expect 2 "expected folders with model.json" diagnose --batch "$folder/nothing"
[ "$failures" -eq 0 ]
