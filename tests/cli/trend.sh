#!/bin/sh
# trend: three runs of which the last differs; what is refused. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
expect 0 "rows in" bench --quick --kernels ring_plain_f32,ring_plain_q15 --orders 0.5 --taps 20,50 --signals step --targets m7 --out "$folder/a.json"
sed '/ring_plain_f32.*m7:stm32f746/,/}/s/"model_cycles_per_sample": \([0-9.]*\)/"model_cycles_per_sample": 2\1/' "$folder/a.json" >"$folder/b.json"
sed 's/"n_samples": 1000/"n_samples": 5000/' "$folder/a.json" >"$folder/other.json"
expect 0 "nothing changed" trend "$folder/a.json" "$folder/a.json"
expect 0 "2 of 2  worse" trend "$folder/a.json" "$folder/a.json" "$folder/b.json" --plot "$folder/trend" --json "$folder/trend.json"
for file in trend.svg trend.png trend.json; do [ -s "$folder/$file" ] || fail "expected the file $file"; done
grep -q '"schema": "glsum-trend-1"' "$folder/trend.json" || fail "expected the schema glsum-trend-1"
expect 2 "RUN: expected two result files or more, the oldest first, found 1" trend "$folder/a.json"
expect 2 "nosuch.json" trend "$folder/a.json" "$folder/nosuch.json"
expect 4 "n_samples" trend "$folder/a.json" "$folder/other.json"
expect 0 "trend of 2 runs" trend "$folder/a.json" "$folder/other.json" --force
[ "$failures" -eq 0 ]
