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
expect 0 "unstable.json: unstable: 2 poles with a positive real part" simulate --model "$folder/unstable.json" --step-s 0.01
printf '{"denominator":[{"coefficient":1,"order":1},{"coefficient":-40,"order":0}]}' >"$folder/away.json"
expect 1 "left the range of its numbers" simulate --model "$folder/away.json" --step-s 0.001 --until-s 20 --no-compare
printf '{"delay_s":-1,"denominator":[{"coefficient":1,"order":1},{"coefficient":1,"order":0}]}' >"$folder/early.json"
expect 2 "delay_s: expected 0 to" simulate --model "$folder/early.json"
printf '{"denominator":[{"coefficient":0,"order":2},{"coefficient":1,"order":0}]}' >"$folder/zero.json"
expect 2 "the coefficient of the highest order, 2, is 0" simulate --model "$folder/zero.json"
printf '{"denominator":[{"coefficient":1,"order":2},{"coefficient":1,"order":0}]}' >"$folder/border.json"
expect 1 "borderline" stability --model "$folder/border.json"
printf '{"numerator":[{"coefficient":1,"order":3}],"denominator":[{"coefficient":1,"order":2}]}' >"$folder/improper.json"
expect 2 "improper" stability --model "$folder/improper.json"

expect 0 "NRMSE printed" indices "$folder/exact.csv" --model "$models/sopdt.json" --model "$models/fopdt.json"
expect 2 "expected --model or --simulated" indices "$folder/exact.csv"
expect 0 "501 samples at 0.01 s" resample "$folder/exact.csv" --step-s 0.01 --out "$folder/even.csv"
expect 2 "--step-s: expected a number above 0, found 0" resample "$folder/exact.csv" --step-s 0

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
{ echo time_s,input,angle_rad; for k in 0 1 2 3 4 5 6 7 8 9; do echo "$k,1,$((k * 5))"; done; } >"$folder/degrees.csv"
expect 0 "more than two turns; are these degrees?" resample "$folder/degrees.csv" --step-s 0.5
expect 2 "--counts-per-unit: expected a number other than 0" identify "$folder/even.csv" --counts-per-unit 0
printf 'time_s,input,counts\n0,1,65530\n1,1,65535\n2,1,4\n' >"$folder/wraps.csv"
expect 2 "wraps.csv:4: counts: jumps by -65531" identify "$folder/wraps.csv"

# A closed loop, stepped by hand: a first order behind 0.1 s, gain 2, 0.5 s, under a PI controller.
awk 'BEGIN { print "time_s,reference,input,output"; a = exp(-0.02 / 0.5)
    for (k = 0; k < 500; ++k) { if (k > 0) { y = a * y + (1 - a) * 2 * (k > 5 ? u[k - 6] : 0); i += 0.8 * 0.02 * e }
        r = int(k / 100) % 2 ? 0.4 : 1; e = r - y; u[k] = 0.6 * e + i; printf "%.2f,%g,%.12g,%.12g\n", k * 0.02, r, u[k], y } }' >"$folder/loop.csv"
echo '{"kind": "pid", "kp": 0.6, "ki": 0.8}' >"$folder/pi.json"
expect 0 "gain                          2 " identify "$folder/loop.csv" --controller "$folder/pi.json" --form fopdt --out "$folder/plant.json"
cut -d, -f1,3,4 "$folder/loop.csv" >"$folder/loop_without.csv"  # the reference is what input and output say it was
expect 0 "gain                          2 " identify "$folder/loop_without.csv" --controller "$folder/pi.json" --form fopdt
expect 2 "expected a column absent for the reference" identify "$folder/loop.csv" --controller "$folder/pi.json" --reference-column absent
expect 2 "expected --controller FILE beside it" identify "$folder/loop.csv" --reference-column reference
echo '{"kind": "pid", "kd": 1}' >"$folder/pd.json"
expect 2 "filter_s: expected a time above 0" identify "$folder/loop.csv" --controller "$folder/pd.json"

expect 0 "0.9977144659 without its dead time" paper
# Models stepped: a design that is not stable is named and left out, the others go on; with none left there is an error.
steps='bench --drive --quick --targets host'
expect 0 "left out: niopdt modesbdf2_plain_f32: expected more taps or modes than 2+7" $steps --kernels 'modes*_plain_f32' --taps 2+7 --out "$folder/steps.json"
grep -q '"drive/niopdt/modesdelta_plain_f32/taps:2+7/host"' "$folder/steps.json" || fail "expected the row of modesdelta_plain_f32"
expect 2 "nothing that can be stepped" $steps --kernels 'modesbdf2*' --taps 2+7 --out "$folder/none.json"
[ "$failures" -eq 0 ]
