#!/bin/sh
# The gate as a script uses it: exit statuses, outputs, baselines. Arguments: the glsum program, the source folder.
set -u
program=$1
source=$2
. "$(dirname "$0")/expect.sh"
rules=$source/results/thresholds.toml
a=$folder/a.json
"$program" bench --quick --targets host --kernels ring_plain_f32,ring_plain_q31,null --orders 0.5 --taps 50 --signals step,noise \
    --benchmark_min_time=0.001 --out "$a" >/dev/null 2>&1 || { echo "no run to gate"; exit 1; }
gate="gate --thresholds $rules --baseline $a --current"

expect 0 "Example:" gate --help
expect 2 "--baseline or --target is required" gate
expect 2 "--target: the baseline that --baseline names is another" $gate "$a" --target host
expect 2 "as host, found m9" gate --target m9 --current "$a"
expect 1 "against $source/results/baselines/host.json" gate --target host --current "$a"
expect 0 "pass: " $gate "$a"
# Times that cannot be judged are said so at once.
expect 0 "against $a; not judged: 3 host times, no row of the anchor" $gate "$a"
"$program" gate --baseline "$folder/untimed.json" --current "$a" --update-baseline --reason test --rows '*/accuracy/*' >/dev/null
expect 0 "pass: " gate --thresholds $rules --baseline "$folder/untimed.json" --current "$a"
! grep -q 'not judged: ' "$folder/said" || { echo "times that nobody asked for are told of"; failures=$((failures + 1)); }
sed -i 's|"\*/accuracy/\*"|"*/accuracy/*", "*/host"|' "$folder/untimed.json"
expect 0 "against $folder/untimed.json; not judged: host times, of which the baseline has none" gate --thresholds $rules --baseline "$folder/untimed.json" --current "$a"
rm -f "$folder/untimed.json"
# One number a little worse: the accuracy layer is named, with both values.
sed '0,/"error_max": 0.0625/s//"error_max": 0.0635/' "$a" >"$folder/worse.json"
cmp -s "$a" "$folder/worse.json" && { echo "the change does not match"; exit 1; }
expect 1 "fail: accuracy: gl/ring_plain_" $gate "$folder/worse.json"
expect 1 "error_max: 0.0625" $gate "$folder/worse.json"
# What is broken is told apart from what is worse.
head -c 2000 "$a" >"$folder/cut.json"
expect 2 "ends in the middle" $gate "$folder/cut.json"
sed '0,/"error_max": [0-9.e-]*/s//"error_max": NaN/' "$a" >"$folder/nan.json"
expect 2 "expected a finite number, found NaN" $gate "$folder/nan.json"
expect 2 "cannot read" $gate "$folder/none.json"
sed 's/ring_plain_f32/ring_other_f32/' "$a" >"$folder/lost.json"
expect 1 "the kernel is lost" $gate "$folder/lost.json"
sed 's/"compiler": "[^"]*"/"compiler": "Other 1.2.3"/' "$a" >"$folder/compiler.json"
expect 4 "Other 1.2.3 now" $gate "$folder/compiler.json"
cp "$folder/compiler.json" "$folder/a-other.json"  # a baseline of that compiler, beside the other's
expect 4 "a-other.json can be compared" $gate "$folder/compiler.json"
rm "$folder/a-other.json"
sed 's/"n_samples": 1000/"n_samples": 5000/' "$a" >"$folder/samples.json"
expect 4 "n_samples: 1000 in the baseline, 5000 now" $gate "$folder/samples.json"
sed '0,/"state_bytes"/s//"error_occurred": true, "error_message": "other bits", "state_bytes"/' "$a" >"$folder/wrong.json"
expect 1 "right_answer: gl/ring_plain_" $gate "$folder/wrong.json"
printf '[[rule]]\nlayer = "accuracy"\nrow = "*"\n' >"$folder/bad.toml"
expect 2 "bad.toml:3:1: expected one of layer" gate --thresholds "$folder/bad.toml" --baseline "$a" --current "$a"

# Outputs: to standard output alone, or to files, also when the gate fails or cannot judge.
for current in a worse cut compiler; do
    "$program" $gate "$folder/$current.json" --json "$folder/g.json" --junit="$folder/g.xml" --markdown "$folder/g.md" --annotations \
        >"$folder/out" 2>"$folder/err"
    for file in g.json g.xml g.md; do
        [ -s "$folder/$file" ] || { echo "$current: expected the file $file"; failures=$((failures + 1)); }
    done
    case $current in a) word=pass ;; worse) word=fail ;; cut) word=refused ;; compiler) word='not comparable' ;; esac
    grep -q "\"verdict\": \"$word\"" "$folder/g.json" || { echo "$current: expected the verdict $word"; failures=$((failures + 1)); }
    [ $current = a ] || grep -q '^::error .*title=glsum gate%3A ' "$folder/out" || { echo "$current: expected an annotation"; failures=$((failures + 1)); }
    [ $current != a ] || ! grep -q '^::' "$folder/out" || { echo "a pass is annotated"; failures=$((failures + 1)); }
    if command -v xmllint >/dev/null 2>&1; then
        xmllint --noout "$folder/g.xml" || { echo "$current: broken XML"; failures=$((failures + 1)); }
    fi
    rm -f "$folder"/g.*
done
"$program" $gate "$folder/worse.json" --json >"$folder/out" 2>/dev/null
[ "$(head -c 1 "$folder/out")" = '{' ] || { echo "--json alone: expected JSON and nothing else"; failures=$((failures + 1)); }
"$program" $gate "$folder/worse.json" --junit >"$folder/out" 2>/dev/null
head -n 1 "$folder/out" | grep -q '^<?xml' || { echo "--junit alone: expected XML and nothing else"; failures=$((failures + 1)); }

# Baselines: recorded with a reason, never from a wrong run; then they pass the run that they are from.
b=$folder/b.json
record="gate --thresholds $rules --baseline $b --update-baseline --current"
expect 2 "expected --reason" $record "$a"
expect 2 "expected --reason" $record "$a" --reason ' '
expect 1 "rows are wrong" $record "$folder/wrong.json" --reason first
[ ! -e "$b" ] || { echo "a refused baseline was written"; failures=$((failures + 1)); }
expect 0 "first recording" $record "$a" --reason first --rows '*/accuracy/*'
expect 0 "pass: " gate --thresholds "$rules" --baseline "$b" --current "$a"
expect 0 "1 worse: accuracy" $record "$folder/worse.json" --reason 'a shorter table'
expect 0 "pass: " gate --thresholds "$rules" --baseline "$b" --current "$folder/worse.json"
expect 0 "better" gate --thresholds "$rules" --baseline "$b" --current "$a"
[ "$(grep -c '"reason"' "$b")" -eq 2 ] && grep -q 'a shorter table' "$b" || { echo "expected two entries of history"; failures=$((failures + 1)); }
[ "$(grep -c '^{"name":"gl/.*/accuracy/' "$b")" -eq "$(grep -c '"name"' "$b")" ] || { echo "expected one selected row a line"; failures=$((failures + 1)); }
[ "$failures" -eq 0 ]
