#!/bin/sh
# gate --elf: functions of a program that knows nothing of us, held to a baseline; an instruction planted in one of three is found
# and named, with what its cycles were lost to, and runs of the same program differ in nothing.
# Arguments: the glsum program; how often the same program is run again, 3 unless given.
set -u
program=$1 reruns=${2:-3}
. "$(dirname "$0")/expect.sh"
. "$(dirname "$0")/../foreign/foreign.sh"
fail() { echo "$*"; failures=$((failures + 1)); }

build() { out=$1; shift; link_foreign "$out" "$@" "$foreign/app.S"; }
build app.elf
held() {  # STATUS TEXT ELF OPTION...
    status=$1 text=$2 elf=$3
    shift 3
    expect "$status" "$text" gate --elf "$folder/$elf" --functions 'ctrl_*' --baseline "$folder/app.json" "$@"
}
told() { grep -qE -e "$1" "$folder/said" || fail "expected '$1', found: $(cat "$folder/said")"; }

held 2 "no such baseline" app.elf
held 2 "--reason" app.elf --update-baseline
held 0 "4 functions recorded" app.elf --update-baseline --reason "first"
grep -q '"reason": "first"' "$folder/app.json" || fail "expected the reason in the baseline"
grep -A 1 '"function": "ctrl_unused"' "$folder/app.json" | grep -q '"calls": 0' || fail "expected no call of ctrl_unused"
cp "$folder/app.json" "$folder/first.json"
# The same program, again and again.
alarms=0 run=0
while [ "$run" -lt "$reruns" ]; do
    before=$failures run=$((run + 1))
    held 0 "4 functions on stm32f746-itcm, 0 changed" app.elf
    alarms=$((alarms + failures - before))
done
echo "$run reruns of one ELF, $alarms raised anything"
held 0 "recorded" app.elf --update-baseline --reason "first"
cmp -s "$folder/app.json" "$folder/first.json" || fail "expected the same baseline of the same program"
# Its figures are those of time, and the stack is what is pushed: four words.
"$program" time --elf "$folder/app.elf" --function ctrl_current --json "$folder/time.json" >/dev/null 2>&1
median=$(tr -d ' \n' <"$folder/time.json" | sed 's/.*"model_cycles":{"min":[0-9.]*,"median":\([0-9.]*\).*/\1/')
tr -d ' \n' <"$folder/app.json" | grep -qF "\"function\":\"ctrl_current\",\"calls\":50,\"code_bytes\":12,\"instructions\":{\"median\":6,\"max\":6},\"model_cycles\":{\"median\":$median," ||
    fail "expected ctrl_current's figures as time has them ($median): $(tr -d ' \n' <"$folder/app.json" | cut -c 1-500)"
tr -d ' \n' <"$folder/app.json" | grep -qF '"stack_bytes":16' || fail "expected a stack of 16 bytes"

# An instruction planted in one of three: that one is named, with what it cost.
build more.elf -DSPEED='udiv r2, r2, r1'
held 1 "gate: worse: ctrl_speed" more.elf
told '^worse  ctrl_speed: cycles .*instructions 5 -> 6 \(\+1\).*code bytes 10 -> 14 \(\+4\); lost to: result_latency \+'
! grep -qE 'ctrl_(current|position)' "$folder/said" || fail "expected no other function to be named: $(cat "$folder/said")"
build loads.elf -DCURRENT='ldr r3, [r4, #16]; ldr r3, [r3]'
held 1 "gate: worse: ctrl_current" loads.elf
told 'lost to: load_use \+'
# Less passes, and is told.
held 0 "recorded" more.elf --update-baseline --reason "a division"
held 0 "1 changed" app.elf
told '^passes ctrl_speed: cycles .*instructions 6 -> 5 \(-1\)'
# Gone, or no longer called.
held 0 "recorded" app.elf --update-baseline --reason "first"
sed 's/ctrl_position/ctrl_place/' "$foreign/app.S" >"$folder/renamed.S"
link_foreign renamed.elf "$folder/renamed.S"
held 1 "gate: worse: ctrl_position" renamed.elf
told '^passes ctrl_place: new'
sed 's/bl ctrl_speed/nop.w/' "$foreign/app.S" >"$folder/uncalled.S"
link_foreign uncalled.elf "$folder/uncalled.S"
held 1 "no longer called" uncalled.elf
# What cannot be compared, and what is broken.
held 4 "cannot be compared" app.elf --core m7-ideal
held 4 "cannot be compared" app.elf --place data=axi
expect 2 "no function's name matches nothing_*" gate --elf "$folder/app.elf" --functions 'nothing_*' --baseline "$folder/app.json"
# Another architecture, no symbols, no end, a fault where no handler is: each in a sentence, the last two with the place.
expect 2 "expected a 32-bit Arm executable" gate --elf /bin/true --functions 'ctrl_*' --baseline "$folder/app.json"
cp "$folder/app.elf" "$folder/stripped.elf" && arm-none-eabi-strip "$folder/stripped.elf"
held 2 "found one without symbols" stripped.elf
sed 's/movs r0, #0x20/b ./' "$foreign/app.S" >"$folder/endless.S"
link_foreign endless.elf "$folder/endless.S"
held 1 "was silent for " endless.elf --timeout 2  # longer where others take the processor
told 'for [0-9]* s and was ended; the last instruction that it executed was at 0x[0-9a-f]* in start$'
sed 's/movs r0, #0x20/udf #0/' "$foreign/app.S" >"$folder/faulty.S"
link_foreign faulty.elf "$folder/faulty.S"
held 1 "Lockup: " faulty.elf
told '; it faulted at 0x000000[0-9a-f]* in start; '
# The outputs of a gate of rows, of functions: a worse one fails in each of them, one that cannot be judged says why.
cp "$folder/first.json" "$folder/app.json"
held 1 "gate: worse: ctrl_speed" more.elf --json "$folder/g.json" --junit "$folder/g.xml" --markdown "$folder/g.md" --annotations
told '^worse  ctrl_speed: cycles '
told '^::error title=glsum gate%3A model_cycles::ctrl_speed: cycles '
tr -d ' \n' <"$folder/g.json" | grep -q '"schema":"glsum-gate-1","verdict":"fail","exit_status":1,.*"rows":4,.*"layer":"model_cycles","compared":4,"failed":1.*"row":"ctrl_speed"' ||
    fail "expected ctrl_speed in the JSON: $(cat "$folder/g.json")"
grep -q 'tests="5" failures="1"' "$folder/g.xml" && grep -A 1 'name="ctrl_speed"' "$folder/g.xml" | grep -q '<failure' || fail "expected one failure in JUnit: $(cat "$folder/g.xml")"
grep -q '^| model\\_cycles | ctrl\\_speed |' "$folder/g.md" || fail "expected ctrl_speed in Markdown: $(cat "$folder/g.md")"
held 0 '"verdict": "pass"' app.elf --json
! grep -q 'functions on' "$folder/said" || fail "expected JSON alone"
held 4 '"verdict": "not comparable"' app.elf --place data=axi --json
echo '{"schema": "glsum-functions-1"}' >"$folder/app.json"
held 2 "app.json: no baseline of functions" app.elf
echo '[' >"$folder/app.json"
held 2 "app.json: no baseline of functions" app.elf
[ "$failures" -eq 0 ]
