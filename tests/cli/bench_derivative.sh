#!/bin/sh
# bench --derivative-error as a person uses it, for one order. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
half="--orders 0.5 --kernels modes_plain_f32,cascade_df2t_f32,ring_plain_f32"
expect 2 "expected --band, --step-until or both" bench --derivative-error 5%
expect 2 "expected a share above 0, as in 5%, found five" bench --derivative-error five --band 1..2
expect 2 "two rising frequencies in Hz, as in 0.05..80, found 80..0.05" bench --derivative-error 5% --band 80..0.05
expect 2 "half the sampling rate, 500 Hz, found 600" bench --derivative-error=5% --band 1..600
expect 2 "of a step is 0" bench --derivative-error 5% --step-until 1 --orders 0.5,1
expect 2 "the nearest is modes_plain_f32" bench --derivative-error 5% --band 1..2 --kernels modes_plian_f32
expect 2 "--derivative-error is required" bench derivative --band 1..2
expect 2 "found count alone" bench --derivative-error 5% --band 1..2 --core count
expect 1 "order 0.5: no kernel comes within 0.001 %" bench --derivative-error 0.001% --band 0.5..80 $half --out "$folder/none.json"
expect 0 "2 of 3 kernels" bench --quick --derivative-error 5% --band 0.05..80 --step-until 60 $half --targets m7,host --out "$folder/d.json"
for row in m7:stm32f746-itcm host; do
    grep -q "\"derivative/modes_plain_f32/order:0.5/taps:1+5/$row/hz:0.05..80/until:60\"" "$folder/d.json" ||
        { echo "expected a row of $row"; failures=$((failures + 1)); }
done
grep -q '"derivative/ring_plain_f32/order:0.5/taps:.*/accuracy/hz:0.05..80/until:60"' "$folder/d.json" ||
    { echo "expected the row of what misses it"; failures=$((failures + 1)); }
# What choose says of the same question.
"$program" choose --order 0.5 --step-s 0.001 --target m7 --derivative-error 5% --band 0.05..80 --step-until 60 --json 2>/dev/null >"$folder/choice.json"
awk -F '[ ,]+' '/"certified"/ { on = 1 } on && /"band_error"/ { print $3; exit }' "$folder/choice.json" >"$folder/chosen"
[ -s "$folder/chosen" ] && grep -qF -f "$folder/chosen" "$folder/d.json" || { echo "expected the certificate of choose: $(cat "$folder/chosen")"; failures=$((failures + 1)); }
[ "$failures" -eq 0 ]
