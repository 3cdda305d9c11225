#!/bin/sh
# bench bands as a person uses it, for one order and band. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
expect 2 "bands: expected two rising frequencies in Hz, as in 0.05..80, found 80..8" bench bands 80..8
expect 2 "half the sampling rate, 500 Hz, found 600" bench bands 8..600
expect 2 "not whole, found 1" bench bands --orders 1
expect 2 "expected 1 to 12 poles, found 13" bench bands --poles 13
expect 2 "no-core" bench bands --core no-core --orders 0.5
expect 0 "times in the median" bench bands 8..80 --orders 0.5 --poles 2,3 --out "$folder/b.json"
for made in b.json b.svg b.png; do
    [ -s "$folder/$made" ] || { echo "expected $made"; failures=$((failures + 1)); }
done
grep -q '"band/oustaloup_f32/order:0.5/taps:1+3/hz:8..80"' "$folder/b.json" || { echo "expected Oustaloup's row"; failures=$((failures + 1)); }
grep -q '"band/oustaloup_df2t_f32/order:0.5/taps:1+3/hz:8..80"' "$folder/b.json" || { echo "expected Oustaloup's cascade"; failures=$((failures + 1)); }
# One tap and three modes: of each a word of state and two coefficients, beside the five words of a sum.
jq -e '[.. | objects | select(.name? == "band/oustaloup_f32/order:0.5/taps:1+3/hz:8..80") | .memory_bytes] == [56]' "$folder/b.json" >"$folder/said" ||
    { echo "expected 56 bytes of Oustaloup's three poles"; failures=$((failures + 1)); }
grep -q '"band/modes_plain_f32/order:0.5/taps:1+3/hz:8..80"' "$folder/b.json" || { echo "expected the kernel's row"; failures=$((failures + 1)); }
"$program" bench bands 8..80 --orders 0.5 --poles 2,3 --out "$folder/c.json" 2>/dev/null | grep -q "errs more in 0;" ||
    { echo "expected the fitted filter to be behind in none"; failures=$((failures + 1)); }
# Above order 1 both forms stand on increments, and hold the same filter.
expect 0 "times in the median" bench bands 8..80 --orders 1.5 --poles 2 --out "$folder/d.json"
jq -e '[.. | objects | select(.name? == ("band/oustaloup_f32/order:1.5/taps:1+2/hz:8..80", "band/oustaloup_df2t_f32/order:1.5/taps:1+2/hz:8..80")).band_error]
    | length == 2 and .[0] / .[1] > 0.99 and .[0] / .[1] < 1.01' "$folder/d.json" >"$folder/said" ||
    { echo "expected Oustaloup's filter of order 1.5 to err alike in both forms"; failures=$((failures + 1)); }
[ "$failures" -eq 0 ]
