#!/bin/sh
# bench horizons as a person uses it, over short pasts. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
expect 2 "--horizons: expected 100 to 10000000 samples, found 99" bench --horizons 99
expect 2 "found 1e3" bench --horizons 600,1e3
expect 2 "that are not whole, found 1" bench --horizons 600 --orders 1
expect 2 "expected a number from -1 to 2, found -1.5" bench --horizons 600 --orders=-1.5
expect 2 "--taps" bench --horizons 600 --taps 16
expect 2 "--equal-cost" bench --horizons 600 --equal-cost 16
expect 0 "drawn in" bench --horizons 5000,600 --orders 0.5 --targets host --out "$folder/h.json"
for made in h.json h.svg h.png; do
    [ -s "$folder/$made" ] || fail "expected $made"
done
# The lengths of the facts: windows of 595 and 4878 taps, 1+9 and 1+11 with modes, for 1e-4; each a multiplication less.
for line in '0.0001 +600 +594 .* 18 \(1\+9\)' '0.0001 +5000 +4877 .* 22 \(1\+11\)'; do
    "$program" bench --horizons 600,5000 --orders 0.5 --targets host --out "$folder/h.json" 2>/dev/null | grep -Eq "$line" ||
        fail "expected a line like $line"
done
expect 0 "stm32f746-itcm" bench --horizons 600 --orders 1.5 --out "$folder/m.json"
[ "$(grep -c '"model_cycles_per_sample"' "$folder/m.json")" -eq 3 ] || fail "expected modelled cycles of three designs"
[ "$failures" -eq 0 ]
