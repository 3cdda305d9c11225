#!/bin/sh
# glsum tune as a person uses it: a controller file that reads back, pictures, what cannot be met and what is wrong. Arguments: the
# glsum program, the folder of the paper's models.
set -u
program=$1
models=$2
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }

expect 0 "60.00         60.00" tune --model "$models/fopdt.json" --margin 60 --crossover 0.6 \
    --sample-time-s 0.01 --out "$folder/pid.json"
for field in '"kind": "fopid"' '"integral_order"' '"derivative_order"' '"filter_s"' '"sample_time_s": 0.01' '"setpoint_weight": 1.0'; do
    grep -qF "$field" "$folder/pid.json" || fail "pid.json: expected $field"
done
expect 0 "The fraction buys nothing" tune --model "$models/fopdt.json" --margin 60 --crossover 0.6 --sample-time-s 0.01 --integer \
    --low 0 --high 1.2 --setpoint-weight 0.5 --out "$folder/integer.json"
for field in '"integral_order": 1.0' '"low": 0.0' '"high": 1.2' '"setpoint_weight": 0.5'; do
    grep -qF "$field" "$folder/integer.json" || fail "integer.json: expected $field"
done
expect 0 '"schema": "glsum-tune-1"' tune --model "$models/niopdt.json" --sensitivity 1.6 --sample-time-s 0.02 --json
if command -v gnuplot >/dev/null 2>&1; then
    expect 0 "largest |S|" tune --model "$models/niopdt.json" --sensitivity 1.6 --sample-time-s 0.02 --plot "$folder/tuned"
    [ -s "$folder/tuned.png" ] && [ -s "$folder/tuned.svg" ] || fail "tune --plot: expected two pictures"
fi

# No: and what could be reached.
expect 1 "with that margin, --crossover" tune --model "$models/niopdt.json" --margin 60 --crossover 1.2 --out "$folder/none.json"
[ ! -e "$folder/none.json" ] || fail "tune: expected no file of a controller that is none"

# Wrong use.
fopdt="tune --model $models/fopdt.json"
expect 2 "expected --margin DEGREES with --crossover" $fopdt
expect 2 "expected both or neither" $fopdt --margin 60
expect 2 "contradict each other" $fopdt --margin 30 --crossover 0.6 --sensitivity 1.5
expect 2 "--low 2 and --high 1 contradict" $fopdt --margin 60 --crossover 0.6 --low 2 --high 1
expect 2 "needs an input of 1" $fopdt --margin 60 --crossover 0.6 --low 0 --high 0.5
expect 2 "--sensitivity" $fopdt --sensitivity 0.9
expect 2 "--margin" $fopdt --margin 200 --crossover 1
expect 2 "--until-s: expected" $fopdt --margin 60 --crossover 0.6 --until-s 1e6
printf '{"denominator":[{"coefficient":1,"order":1},{"coefficient":1,"order":0}],"delay_s":1}' >"$folder/untimed.json"
expect 2 "has no sample_time_s" tune --model "$folder/untimed.json" --sensitivity 1.6
printf '{"denominator":[{"coefficient":1,"order":1},{"coefficient":-1,"order":0}],"sample_time_s":0.1}' >"$folder/growing.json"
expect 2 "1 poles with a positive real part" tune --model "$folder/growing.json" --sensitivity 1.6
printf '{"numerator":[{"coefficient":1,"order":1}],"denominator":[{"coefficient":1,"order":1},{"coefficient":1,"order":0}],"sample_time_s":0.1}' \
    >"$folder/direct.json"
expect 2 "does not answer its input at once" tune --model "$folder/direct.json" --sensitivity 1.6
[ "$failures" -eq 0 ]
