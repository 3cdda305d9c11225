#!/bin/sh
# The second core as a person asks for it: rows, choices, headers, models, a function's time, the gate and the page.
# Arguments: the glsum program; the build folder of the M4's firmware.
set -u
program=$1 firmware=$2
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
if [ ! -e "$firmware/targets/measure.elf" ] || ! command -v qemu-system-arm >/dev/null 2>&1; then
    echo "no firmware of the M4 in $firmware, or no emulator"
    [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ] && exit 1
    exit 77
fi
core=cortex-m4-zerowait
bench() {
    out=$1
    shift
    "$program" bench --quick --orders 0.5 --signals step --taps 50 --kernels 'ring_plain_q31,mirror_multi_f32,ring_oldest_f64' \
        --out "$folder/$out.json" "$@" >"$folder/$out.txt" 2>&1 || fail "bench $*: $(tail -n 3 "$folder/$out.txt")"
}
counter() {
    awk -F, -v row="$2" -v counter="$3" 'NR == 1 {for (i = 1; i <= NF; i++) if ($i == counter) column = i}
        $1 == row {print $column}' "$folder/$1.csv"
}

# Rows: alone, and beside the M7's, whose figures they leave as they are.
bench m4 --targets m4
bench m7 --targets m7
bench both --targets m7,m4
for kernel in ring_plain_q31 mirror_multi_f32 ring_oldest_f64; do
    row=gl/$kernel/order:0.5/taps:50
    for name in model_cycles_per_sample model_cycles_low model_cycles_high instructions_per_sample code_bytes; do
        [ -n "$(counter m4 $row/m4:$core $name)" ] || fail "$row/m4:$core: expected the counter $name"
        [ "$(counter m4 $row/m4:$core $name)" = "$(counter both $row/m4:$core $name)" ] || fail "m4 $name changes beside m7"
        [ "$(counter m7 $row/m7:stm32f746-itcm $name)" = "$(counter both $row/m7:stm32f746-itcm $name)" ] || fail "m7 $name changes beside m4"
    done
    [ -n "$(counter m4 $row/m4:count instructions_per_sample)" ] || fail "expected $row/m4:count"
done
# 24 MHz, one instruction a cycle at the most.
awk -v t="$(counter m4 gl/ring_plain_q31/order:0.5/taps:50/m4:$core real_time)" \
    -v c="$(counter m4 gl/ring_plain_q31/order:0.5/taps:50/m4:$core model_cycles_per_sample)" \
    -v i="$(counter m4 gl/ring_plain_q31/order:0.5/taps:50/m4:$core instructions_per_sample)" \
    'BEGIN {exit !(t * 0.024 - c < 1e-6 && c - t * 0.024 < 1e-6 && c > i)}' || fail "expected the time of the cycles at 24 MHz, and more cycles than instructions"
! grep -q '"error_occurred": true' "$folder/both.json" || fail "a row is wrong: the bits are not the host's"
grep -q 'm7:' "$folder/m4.json" && fail "m7 was not asked for"
grep -q '; M7 cycles modelled for stm32f746-itcm; M4 cycles modelled for cortex-m4-zerowait$' "$folder/both.txt" || fail "expected both cores' names over the table"
grep -q 'double in software on the M4' "$folder/m4.txt" || fail "expected the note of double in software"
grep -q '"m4_target_flags": "-mcpu=cortex-m4' "$folder/both.json" || fail "expected the M4's flags beside the M7's"
expect 2 "of a Cortex-M4; expected --targets with m4" bench --quick --targets m7 --core $core --out "$folder/bad.json"
expect 2 "too" bench --quick --targets m7,m4 --core $core --out "$folder/bad.json"
expect 2 "expected some of host, m7, m4, found m5" bench --quick --targets m5 --out "$folder/bad.json"

# Gate and page take them as they are.
"$program" gate --baseline "$folder/m4.json" --current "$folder/m4.json" >"$folder/said" 2>&1 || fail "gate: $(tail -n 3 "$folder/said")"
awk '$1 == "\"model_cycles_per_sample\":" && !done {sub(/,$/, "", $2); printf "%s %.17g,\n", $1, $2 * 1.01; done = 1; next} {print}' \
    "$folder/m4.json" >"$folder/slower.json"
"$program" gate --baseline "$folder/m4.json" --current "$folder/slower.json" >"$folder/said" 2>&1
[ $? -eq 1 ] && grep -q "model_cycles: .*model_cycles_per_sample" "$folder/said" || fail "one per cent more: $(head -n 3 "$folder/said")"
# Of runs of other targets those are judged that both have; the first line says which were not.
for was_is in "both m4 m7, which this run was not asked for" "m4 both m7, of which the baseline has none"; do
    set -- $was_is
    was=$1 is=$2 left=$3
    shift 3
    "$program" gate --baseline "$folder/$was.json" --current "$folder/$is.json" >"$folder/said" 2>&1 || fail "gate of $is by $was: $(tail -n 3 "$folder/said")"
    head -n 1 "$folder/said" | grep -q "not judged: [1-9][0-9]* rows of $left $*$" || fail "gate of $is by $was: expected what was not judged, found $(head -n 1 "$folder/said")"
done
"$program" gate --baseline "$folder/both.json" --current "$folder/slower.json" >"$folder/said" 2>&1
[ $? -eq 1 ] && grep -q "model_cycles: .*model_cycles_per_sample" "$folder/said" || fail "one per cent more than in a run on both: $(head -n 3 "$folder/said")"
sed 's/"m4_target_compiler": "/&another /' "$folder/both.json" >"$folder/compiled.json"
"$program" gate --baseline "$folder/m4.json" --current "$folder/compiled.json" >"$folder/said" 2>&1
[ $? -eq 4 ] && grep -q "not comparable: m4_target_compiler: " "$folder/said" || fail "another compiler of the M4: $(tail -n 1 "$folder/said")"
expect 0 "" report "$folder/both.json" --out "$folder/page.html"
grep -q "m4:$core" "$folder/page.html" || fail "expected the M4's rows on the page"

# Choices: of the M4, and beside the M7's.
ask="--order 0.5 --step-s 0.001 --max-error 0.05 --quick --fresh"
expect 0 "modelled for $core, on the emulated Cortex-M4" choose $ask --target m4
expect 0 "the model's upper end takes" choose $ask --target m4 --clock-hz 24e6 --rate-hz 1000
expect 0 "a core that issues one instruction a cycle" choose $ask --target m4 --max-instructions 5000 --clock-hz 24e6 --rate-hz 1000
expect 0 "What was chosen for one core is shown on the other" choose $ask --target m7,m4 --json "$folder/both-choices.json"
grep -qE "^  Cortex-M4 +$core .*%  chosen\$" "$folder/said" && grep -qE "^  Cortex-M7 +stm32f746-itcm .*%  chosen\$" "$folder/said" ||
    fail "expected what was chosen for each core: $(tail -n 8 "$folder/said")"
[ "$(grep -c '"share"' "$folder/both-choices.json")" -ge 2 ] && grep -q '"schema": "glsum-choices-1"' "$folder/both-choices.json" ||
    fail "expected both cores in the file: $(head -n 5 "$folder/both-choices.json")"
expect 2 "of a Cortex-M4; expected --target m4" choose $ask --target m7 --core $core
expect 2 "expected one --target" choose $ask --target m7,m4 --clock-hz 24e6 --rate-hz 1000
expect 2 "of several, m7 and m4, found host" choose $ask --target host,m4

# A header with the M4's bits, models at 1 kHz, a function's time.
expect 0 "on the emulated Cortex-M4, of the registered kernel" generate --order 0.5 --kernel mirror_multi_f32 --taps 50 --verify --target m4
expect 0 "M4: instructions a step" bench models --targets m4 --kernels ringdelta_plain_f32 --taps 100 --out "$folder/models.json"
grep -q "/taps:100/m4:$core\"" "$folder/models.json" || fail "expected the models' rows"
expect 0 " M7 instr.      model cycles   period  M4 instr." bench models --targets m7,m4 --kernels ringdelta_plain_f32 --taps 100 --out "$folder/models.json"
grep -q "/taps:100/m7:stm32f746-itcm\"" "$folder/models.json" && grep -q "/taps:100/m4:$core\"" "$folder/models.json" || fail "expected the models' rows of both"
expect 0 "m7 cycles  m4 cycles" bench horizons 150 --orders 0.5 --targets m7,m4 --out "$folder/horizons.json"
grep -q "horizon/modes/order:0.5/error:0.01/samples:150/m4:$core\"" "$folder/horizons.json" || fail "expected the M4's row of a horizon"
expect 2 "of a Cortex-M4; expected --targets with m4" bench models --targets m7 --core $core --out "$folder/bad.json"
expect 0 "biquad_step on $core" time --elf "$firmware/targets/biquad.elf" --function biquad_step --core $core
expect 0 "biquad_step on stm32h747-m4" time --elf "$firmware/targets/biquad.elf" --function biquad_step --core stm32h747-m4
expect 2 "no such core" time --elf "$firmware/targets/biquad.elf" --function biquad_step --core cortex-m5
[ "$failures" -eq 0 ]
