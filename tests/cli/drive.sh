#!/bin/sh
# The drive's commands as a person uses them, from a model to a log and back, and what wrong input says. Arguments: the glsum
# program, the folder of the paper's models.
set -u
program=$1
models=$2
. "$(dirname "$0")/expect.sh"

expect 0 "0.375940553423532331" simulate --model "$models/niopdt.json" --at 1.5
expect 0 "largest error over the record 0.00053" simulate --model "$models/niopdt.json" --out "$folder/y.csv"
expect 0 "ring_oldest_f32" simulate --model "$models/niopdt.json" --kernel ring_oldest_f32 --increments --taps 100 --jobs 2
expect 0 "at 5 s the output is" simulate --model "$models/sopdt.json" --exact --until 5 --out "$folder/exact.csv"
expect 2 "no kernel is called ring_plane_f32" simulate --model "$models/niopdt.json" --kernel ring_plane_f32
expect 2 "--taps: expected a number of at least 1 or full, found 0" simulate --model "$models/niopdt.json" --taps 0
expect 2 "expected step, pulse, staircase or a CSV file" simulate --model "$models/niopdt.json" --input square
expect 2 "cannot read" simulate --model "$folder/none.json"

expect 0 "stable" stability --model "$models/niopdt.json"
expect 2 "of degree 1991; expected at most 600" stability --model "$models/niopdt.json" --q 0.001
printf '{"denominator":[{"coefficient":1,"order":2.1},{"coefficient":1,"order":0}]}' >"$folder/unstable.json"
expect 1 "unstable" stability --model "$folder/unstable.json"
printf '{"denominator":[{"coefficient":1,"order":2},{"coefficient":1,"order":0}]}' >"$folder/border.json"
expect 1 "borderline" stability --model "$folder/border.json"
printf '{"numerator":[{"coefficient":1,"order":3}],"denominator":[{"coefficient":1,"order":2}]}' >"$folder/improper.json"
expect 2 "improper" stability --model "$folder/improper.json"

expect 0 "NRMSE printed" indices "$folder/exact.csv" --model "$models/sopdt.json" --model "$models/fopdt.json"
expect 2 "expected --model or --simulated" indices "$folder/exact.csv"
expect 0 "501 samples at 0.01 s" resample "$folder/exact.csv" --step-s 0.01 --out "$folder/even.csv"
expect 2 "expected a step" resample "$folder/exact.csv" --step-s 0

expect 0 "time_constant_s" identify "$folder/even.csv" --form sopdt --out "$folder/found.json"
grep -q '"time_constant_s": 0.319' "$folder/found.json" || { echo "identify: expected 0.319, found:"; cat "$folder/found.json"; failures=$((failures + 1)); }
expect 0 "exp(-1.0" identify "$folder/even.csv" --form sopdt --start tangent --method none
expect 2 "expected one of the parameters" identify "$folder/even.csv" --form sopdt --fix tau
expect 2 "expected a log" identify
printf 'time_s,input,output\n0,1,0\n' >"$folder/one.csv"
expect 2 "one.csv: expected at least 2 samples, found 1" identify "$folder/one.csv"
printf 'time_s,input,output\n0,1,0\n1,1,nan\n' >"$folder/nan.csv"
expect 2 "nan.csv:3: output: expected a finite number, found 'nan'" identify "$folder/nan.csv"

{ echo time_s,input,output; for k in 0 1 2 3 4 5 6 7 8 9; do echo "$k,1,3"; done; } >"$folder/still.csv"
expect 2 "the output is 3 throughout" identify "$folder/still.csv"
{ echo time_s,input,output; for k in 0 1 2 3 4 5 6 7 8 9; do echo "$k,0,$k"; done; } >"$folder/off.csv"
expect 2 "the input is 0 throughout" identify "$folder/off.csv"
printf 'time_s,duty,angle_rad\n0,27,0\n1,27,1\n' >"$folder/percent.csv"
expect 2 "percent.csv:2: duty: expected 0 to 1, found 27" identify "$folder/percent.csv"
printf 'time_s,input,counts\n0,1,65530\n1,1,65535\n2,1,4\n' >"$folder/wraps.csv"
expect 2 "wraps.csv:4: counts: jumps by -65531" identify "$folder/wraps.csv"

expect 0 "0.9977144659 without its dead time" paper
[ "$failures" -eq 0 ]
