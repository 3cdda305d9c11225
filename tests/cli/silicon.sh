#!/bin/sh
# silicon: published rows, rows of registered kernels and of the loops for rival rules; files that are wrong.
# Arguments: the glsum program; the project's folder.
set -u
program=$1 source=$2
. "$(dirname "$0")/expect.sh"
if ! command -v qemu-system-arm >/dev/null 2>&1 || [ ! -e "$source/build/mps2-an500/targets/silicon.elf" ]; then
    echo "no emulator, or no firmware"
    [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ] && exit 1
    exit 77
fi
fail() { echo "$*"; failures=$((failures + 1)); }
rows() { printf '%s\n' kernel,code,data,maintenance,taps,cycles "$@" >"$folder/rows.csv"; }

# The published rows: within the bounds, slope and constant apart.
expect 0 "24 of 24 rows within 5 % or 8 cycles" silicon
grep -q '^shift_fir_q31 *flash_cached *dtcm *4\.000' "$folder/said" || fail "expected the measured slope 4.000; found $(tail -n 8 "$folder/said")"

# Registered kernels, in any placement: what is predicted, measured again, is met; a tenth more is missed.
kernels="ring_plain_f32,flash_cached,dtcm,0,100 mirror_smlald_q15,itcm,dtcm,0,50 ring_plain_q31,flash,dtcm,0,20
    shift_plain_f64,itcm,axi,1,10 ring_horner_f32,itcm,dtcm,0,600 rival_fma_chain,itcm,dtcm,0,50"
set --
for kernel in $kernels; do set -- "$@" "$kernel,1000"; done
rows "$@"
"$program" silicon --core stm32f746-itcm "$folder/rows.csv" >"$folder/said" 2>&1
[ $? -eq 1 ] || fail "expected status 1 for made-up cycles; found $(tail -n 3 "$folder/said")"
predicted() { awk -v name="$1" '$1 == name && $5 == 1000 {print $6}' "$folder/said"; }
set --
for kernel in $kernels; do
    cycles=$(predicted "${kernel%%,*}")
    [ -n "$cycles" ] || fail "no prediction for $kernel in: $(cat "$folder/said")"
    set -- "$@" "$kernel,${cycles:-1}"
done
rows "$@"
expect 0 "6 of 6 rows within 5 % or 8 cycles" silicon --core stm32f746-itcm "$folder/rows.csv"
rows "$@" ring_plain_f32,itcm,dtcm,0,600,1
expect 1 "1 of 7 rows are missed" silicon --core stm32f746-itcm "$folder/rows.csv"
grep -q 'ring_plain_f32.*MISSED' "$folder/said" || fail "expected the missed row to be marked"

# Slower memories cost more; maintenance costs what the core file says.
rows ring_plain_f32,itcm,dtcm,0,100,1 ring_plain_f32,flash_cached,dtcm,0,100,1 ring_plain_f32,flash,dtcm,0,100,1 \
    ring_plain_f32,itcm,axi,0,100,1 ring_plain_f32,itcm,axi,1,100,1
"$program" silicon --core stm32f746-itcm "$folder/rows.csv" >"$folder/said" 2>&1
awk '$1 == "ring_plain_f32" && $5 == 1 {print $6}' "$folder/said" >"$folder/cycles"
{ read -r itcm; read -r cached; read -r flash; read -r axi; read -r maintained; } <"$folder/cycles"
awk -v a="$itcm" -v b="$cached" -v c="$flash" -v d="$axi" -v e="$maintained" \
    'BEGIN {exit !(a <= b && b < c && a <= d && e > d)}' ||
    fail "expected itcm <= cached < flash, axi < axi with maintenance; found $itcm $cached $flash $axi $maintained"

# Wrong files: one error with file and line.
rows ring_plain_f32,itcm,dtcm,0,100,1 no_such_f32,itcm,dtcm,0,10,1
expect 2 "rows.csv:3: kernel: expected" silicon "$folder/rows.csv"
rows mirror_simd_f32,itcm,dtcm,0,10,1
expect 2 "found mirror_simd_f32" silicon "$folder/rows.csv"
rows ring_plain_f32,itcm,dtcm,0,100
expect 2 "rows.csv:2: expected 6 cells, found 5" silicon "$folder/rows.csv"
rows ring_plain_f32,itcm,dtcm,0,100000,1
expect 2 "rows.csv:2: taps: ring_plain_f32 takes 1 to 1024, found 100000" silicon "$folder/rows.csv"
rows shift_fir_q31,itcm,dtcm,0,129,1
expect 2 "takes 1 to 128, found 129" silicon "$folder/rows.csv"
expect 2 "none.csv" silicon "$folder/none.csv"
expect 2 "no such core" silicon --core no-such-core
[ "$failures" -eq 0 ]
