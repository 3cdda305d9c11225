#!/bin/sh
# diagnose cycles: published rows from nothing and from their own core; another binary; files that are wrong.
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
published=$source/results/silicon/h747_per_sample_fir.csv
verdict=$folder/verdict.json
has() { grep -q -- "$1" "$verdict" || fail "expected $1 in the verdict; found $(head -n 60 "$verdict")"; }

# Told nothing: integer slopes and constants from rules, the maintenance, and what no rule parts.
expect 0 "ambiguous: the gap to m7-ideal" diagnose cycles --measured "$published" --json "$verdict"
has '"schema": "glsum-gap-1"'
has '"verdict": "ambiguous"'
for effect in single_issue result_latency call_overhead cache_maintenance fpu_latency load_bank_conflict; do
    has "\"effect\": \"$effect\""
done
for key in slope constant kernel placement call noise_floor next_experiment; do has "\"$key\""; done
grep -q 'rival_' "$folder/said" || fail "expected micro-loops to run next; found $(tail -n 3 "$folder/said")"
cycles=$(sed -n '/^cache_maintenance/s/ cycles.*//p' "$folder/said" | sed 's/.* //')
[ "${cycles%.*}" -ge 90 ] && [ "${cycles%.*}" -le 100 ] || fail "expected a maintenance of 90 to 100 cycles, found $cycles"
# Its own core explains it.
expect 0 "no_gap: the gap to stm32h747-dtcm" diagnose cycles --measured "$published" --core stm32h747-dtcm

# Slower by 60 cycles a call: the overhead, and how much.
printf '%s\n' kernel,code,data,maintenance,taps,cycles >"$folder/later.csv"
sed -n '/^shift.*,0,[0-9]*,[0-9]*$/p' "$published" | awk -F, 'BEGIN { OFS = "," } { $6 += 60; print }' >>"$folder/later.csv"
expect 0 "attributed" diagnose cycles --measured "$folder/later.csv" --core stm32h747-dtcm --json "$verdict"
has '"effect": "call_overhead"'

# Other instructions than ours: no core is judged.
printf '%s\n' kernel,code,data,maintenance,taps,cycles,instructions shift_fir_q31,flash_cached,dtcm,0,5,47,9 >"$folder/other.csv"
expect 0 "different_binary" diagnose cycles --measured "$folder/other.csv" --json "$verdict"
has '"verdict": "attributed"'
has '"noise_floor": 0.0'  # nothing was judged

# Blind: sealed before anything is diagnosed, each from its file, and what it says is right but for a case or two.
expect 2 "expected --measured FILE or --blind N" diagnose cycles
expect 2 "expected --out FOLDER" diagnose cycles --blind 2
expect 2 "neither --measured nor --json" diagnose cycles --blind 2 --out "$folder/blind" --measured "$published"
expect 0 "6 cases of stm32f746-itcm, sealed: sha256 " diagnose cycles --blind 6 --seed 1 --out "$folder/blind"
hash=$(sed -n 's/.*sealed: sha256 //p' "$folder/said")
[ "$hash" = "$(sha256sum "$folder/blind/truth.json" | cut -d ' ' -f 1)" ] || fail "the truth has another hash than was told"
[ "$(grep -c '^  case-00[1-6].*' "$folder/said")" -eq 6 ] || fail "expected six lines; found $(cat "$folder/said")"
[ "$(grep -c 'WRONG$' "$folder/said")" -le 1 ] || fail "more than one wrong of six; found $(cat "$folder/said")"
cp "$folder/said" "$folder/blind.txt"
# The same file by itself says the same.
line=$(sed -n 's/^  case-005  *[a-z]* .*\(attributed\|no_gap\|unknown\|ambiguous\): .*/\1/p' "$folder/blind.txt")
expect 0 "$line" diagnose cycles --measured "$folder/blind/case-005.csv" --core stm32f746-itcm

expect 2 "expected the column" diagnose cycles --measured "$source/README.md"
expect 2 "cannot read" diagnose cycles --measured "$folder/none.csv"
expect 2 "m8" diagnose cycles --measured "$published" --core m8
printf '%s\n' kernel,code,data,maintenance,taps,cycles ring_plain_f32,itcm,dtcm,0,50,nan >"$folder/nan.csv"
expect 2 "nan.csv:2" diagnose cycles --measured "$folder/nan.csv"
[ "$failures" -eq 0 ]
