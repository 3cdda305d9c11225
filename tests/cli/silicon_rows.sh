#!/bin/sh
# silicon --rows: measured cycles of any program's functions, here of the example's; files that are wrong.
# Arguments: the glsum program; the build folder of the emulated board's firmware.
set -u
program=$1 firmware=$2
. "$(dirname "$0")/expect.sh"
if ! command -v qemu-system-arm >/dev/null 2>&1 || [ ! -e "$firmware/targets/biquad.elf" ]; then
    echo "no emulator, or no firmware"
    [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ] && exit 1
    exit 77
fi
fail() { echo "$*"; failures=$((failures + 1)); }
mkdir "$folder/programs"
cp "$firmware/targets/biquad.elf" "$folder/programs/own.elf"
header=elf,function,core,code,data,measured,per
rows() { printf '%s\n' "# by hand" "$header" "$@" >"$folder/rows.csv"; }
in_file() { grep -qsF -e "$2" "$1" || fail "$(basename "$1"): expected $2; found: $(tr -d '\n' <"$1" | cut -c 1-900)"; }
# What `time` says of it: a row of the same number is met, paths count from the CSV's folder.
cycles() {  # FUNCTION OPTION...
    function=$1
    shift
    "$program" time --elf "$folder/programs/own.elf" --function "$function" --json "$folder/time.json" "$@" >/dev/null 2>&1
    sed -n '/"model_cycles"/,/}/s/.*"median": \([0-9.]*\).*/\1/p' "$folder/time.json"
}
tcm=$(cycles biquad_step)
flash=$(cycles biquad_step --core stm32f746-flash-nocache)
whole=$(cycles firmware_main)
[ -n "$tcm" ] && [ -n "$flash" ] && [ -n "$whole" ] && [ "$tcm" != "$flash" ] || fail "expected cycles, found '$tcm' '$flash' '$whole'"
a_step=$(awk -v c="$whole" 'BEGIN {printf "%.17g", c / 1000}')
rows "programs/own.elf,biquad_step,stm32f746-itcm,itcm,dtcm,$tcm,1" \
    "programs/own.elf,biquad_step,stm32f746-flash-nocache,,,$flash,1" \
    "programs/own.elf,firmware_main(),stm32f746-itcm,,,$a_step,1000"
expect 0 "median error 0.00 %, worst +0.0 %; 3 of 3 rows within 5 % or 8 cycles" silicon --rows "$folder/rows.csv" --json "$folder/fit.json"
in_file "$folder/said" "100.0 % of the rows inside the band"
for field in '"schema": "glsum-silicon-rows-1"' '"median_error": 0.0' '"worst_error": 0.0' '"inside_band": 1.0' '"median_half_width": 0.' \
    '"mean_interval_score": 0.' '"missed": 0' "\"predicted\": $tcm" '"line": 5' '"branch_mispredict": ' '"slopes": []'; do
    in_file "$folder/fit.json" "$field"
done
# From another folder, too.
(cd "$folder/programs" && "$program" silicon --rows ../rows.csv >"$folder/said" 2>&1) || fail "from elsewhere: $(tail -n 2 "$folder/said")"

# A core file of one's own, named by its path.
printf 'base = "stm32f746-itcm"\n' >"$folder/mine.toml"
rows "programs/own.elf,biquad_step,$folder/mine.toml,,,$tcm,1" "programs/own.elf,biquad_step,stm32f746-flash-nocache,,,$flash,1"
expect 0 "median error 0.00 %" silicon --rows "$folder/rows.csv"

# One that is missed: by 5 % and 8 cycles of a call, not of its parts; calls of different length have a line.
rows "programs/own.elf,biquad_step,stm32f746-itcm,itcm,dtcm,$(awk -v c="$tcm" 'BEGIN {print c / 2}'),1" \
    "programs/own.elf,firmware_main,stm32f746-itcm,itcm,dtcm,$(awk -v c="$a_step" 'BEGIN {print c * 0.5}'),1000" \
    "programs/own.elf,biquad_step,stm32f746-itcm,itcm,dtcm,$(awk -v c="$tcm" 'BEGIN {print c - 7}'),1"
expect 1 "2 of 3 rows are missed by more than 5 % and 8 cycles" silicon --rows "$folder/rows.csv"
[ "$(grep -c 'outside' "$folder/said")" -eq 3 ] || fail "expected 3 rows outside the band: $(cat "$folder/said")"
[ "$(grep -c 'outside  MISSED$' "$folder/said")" -eq 2 ] || fail "expected 2 missed rows"
grep -q '0.0 % of the rows inside the band' "$folder/said" || fail "expected the coverage"
in_file "$folder/said" "lost to, cycles as measured"
# An effect that costs nothing moves the prediction.
rows "programs/own.elf,biquad_step,stm32f746-itcm,itcm,dtcm,$tcm,1"
expect 0 "median error 0.00 %" silicon --rows "$folder/rows.csv"
"$program" silicon --rows "$folder/rows.csv" --without fpu_latency >"$folder/said" 2>&1
grep -q "median error 0.00 %" "$folder/said" && fail "--without fpu_latency: expected another prediction"

# Wrong files: one error with file and line.
wrong() {  # ROW TEXT
    rows "programs/own.elf,biquad_step,stm32f746-itcm,itcm,dtcm,100,1" "$1"
    expect 2 "rows.csv:4: $2" silicon --rows "$folder/rows.csv"
    [ "$(wc -l <"$folder/said")" -eq 1 ] || fail "$1: expected one line; found $(cat "$folder/said")"
}
wrong "programs/own.elf,biquad_step,stm32f746-itcm,itcm,dtcm,100" "expected 7 cells, found 6"
wrong "programs/own.elf,biquad_step,stm32f746-itcm,sram,dtcm,100,1" "code: expected"
wrong "programs/own.elf,biquad_step,stm32f746-itcm,itcm,stack,100,1" "data: expected"
wrong "programs/own.elf,biquad_step,stm32f746-itcm,itcm,dtcm,many,1" "measured: expected a number"
wrong "programs/own.elf,biquad_step,stm32f746-itcm,itcm,dtcm,100,0" "per: expected a number"
wrong "programs/own.elf,,stm32f746-itcm,itcm,dtcm,100,1" "function: expected a name"
wrong "programs/own.elf,nowhere,stm32f746-itcm,itcm,dtcm,100,1" "$folder/programs/own.elf: no function nowhere"
wrong "programs/own.elf,biquad_step,no-such-core,itcm,dtcm,100,1" "no-such-core: no such core"
wrong "programs/none.elf,biquad_step,stm32f746-itcm,itcm,dtcm,100,1" "$folder/programs/none.elf"
wrong "rows.csv,biquad_step,stm32f746-itcm,itcm,dtcm,100,1" "$folder/rows.csv"
printf '%s\n' elf,function,core,code,data,measured a,b,c,itcm,dtcm,1 >"$folder/rows.csv"
expect 2 "rows.csv:1: expected the column per" silicon --rows "$folder/rows.csv"
printf '%s\n' "$header" >"$folder/rows.csv"
expect 2 "expected rows of measured cycles, found none" silicon --rows "$folder/rows.csv"
expect 2 "none.csv" silicon --rows "$folder/none.csv"
rows "programs/own.elf,biquad_step,stm32f746-itcm,itcm,dtcm,$tcm,1"
expect 2 "--rows" silicon --rows "$folder/rows.csv" --core stm32f746-itcm
expect 2 "--rows" silicon --json "$folder/fit.json"
expect 2 "rows.csv/fit.json" silicon --rows "$folder/rows.csv" --json "$folder/rows.csv/fit.json"
# What runs wrong names the row, too.
rows "programs/own.elf,fault_handler,stm32f746-itcm,itcm,dtcm,100,1"
expect 1 "rows.csv:3: $folder/programs/own.elf: the timed function was never called" silicon --rows "$folder/rows.csv"
[ "$failures" -eq 0 ]
