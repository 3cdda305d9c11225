#!/bin/sh
# bench --weights: what it refuses and leaves out, and that what reads the files knows their weights. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
small="--quick --orders 0.5 --taps 50 --signals step,sine5 --targets host --benchmark_min_time=0.001"

expect 2 "--weights: expected one of gl, shifted, bdf2, bdf3, bdf4, found bdf5" bench --weights bdf5
expect 2 "--weights bdf2: only with --targets host" bench --quick --weights bdf2 --targets host,m7
expect 2 "--weights bdf2: only with --targets host" bench --quick --weights bdf2 --targets m7
expect 2 "--weights" bench --drive --weights bdf2
expect 2 "--weights bdf2: none of the kernels can sum them" bench $small --weights bdf2 --kernels 'mirrorhold*'
for weights in gl shifted bdf2 bdf3 bdf4; do
    kernels='ring_plain_f32,ring_horner_q31,mirrorhold_plain_f32,modes_plain_f32,peer_std_f32'
    "$program" bench $small --weights $weights --kernels "$kernels" --out "$folder/$weights.json" >"$folder/$weights.txt" 2>"$folder/$weights.err" ||
        fail "--weights $weights: $(tail -n 3 "$folder/$weights.err")"
    grep -q "\"weights\": \"$weights\"" "$folder/$weights.json" || fail "$weights: expected the context's weights"
    grep -q "discretisation error max, weights $weights" "$folder/$weights.txt" || fail "$weights: expected the table"
    left_out=$(grep -c 'leaves out' "$folder/$weights.err")
    case $weights in
        bdf*)
            [ "$left_out" -eq 1 ] || fail "$weights: expected one line about what is left out, found $left_out"
            for kernel in ring_horner_q31 mirrorhold_plain_f32; do
                grep 'leaves out' "$folder/$weights.err" | grep -q "$kernel" || fail "$weights: $kernel is left out in silence"
                grep -q "gl/$kernel/" "$folder/$weights.json" && fail "$weights: $kernel has rows"
            done
            grep -q 'gl/modes_plain_f32/order:0.5/taps:[0-9]*+[0-9]*/host' "$folder/$weights.json" || fail "$weights: expected rows with modes"
            ;;
        *) [ "$left_out" -eq 0 ] || fail "$weights: nothing is to be left out" ;;
    esac
done
grep -q '"0.5": 1.2247448713915' "$folder/bdf2.json" || fail "expected w_0 of bdf2 at order 0.5, the root of 3/2"

# Runs of different weights are not compared, whichever is the older.
expect 4 "weights: gl in the baseline, bdf2 now" gate --baseline "$folder/gl.json" --current "$folder/bdf2.json"
expect 4 "weights: shifted in the baseline, gl now" gate --baseline "$folder/shifted.json" --current "$folder/gl.json"
expect 4 "weights: bdf2 in A, bdf3 in B" compare "$folder/bdf2.json" "$folder/bdf3.json"
grep -v '"weights"' "$folder/gl.json" >"$folder/older.json"
expect 4 "weights: gl in the baseline, bdf2 now" gate --baseline "$folder/older.json" --current "$folder/bdf2.json"
expect 0 "pass: " gate --baseline "$folder/older.json" --current "$folder/gl.json"
expect 0 "everything is measured afresh, not of bdf2.json: its weights are bdf2, not gl" \
    choose --order 0.5 --step-s 0.001 --target host --samples 60 --max-error 0.1 --results "$folder/bdf2.json"
expect 0 "bdf2.html" report "$folder/bdf2.json" "$folder/gl.json"
grep -q "Letnikov's weights, not of" "$folder/bdf2.html" || fail "expected why the page has no bound"
for part in 1 2; do
    "$program" bench $small --weights bdf2 --kernels ring_plain_f32 --shard $part/2 --out "$folder/part-$part.json" >/dev/null 2>&1
done
expect 0 "weights bdf2" merge "$folder/part-1.json" "$folder/part-2.json" --out "$folder/whole.json"
"$program" bench $small --kernels ring_plain_f32 --shard 2/2 --out "$folder/part-2.json" >/dev/null 2>&1
expect 4 "weights differs" merge "$folder/part-1.json" "$folder/part-2.json" --out "$folder/whole.json"
[ "$failures" -eq 0 ]
