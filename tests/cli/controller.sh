#!/bin/sh
# generate --controller: what is refused, and the header in a loop around plant (12) beside full memory in double.
# Arguments: the glsum program, the sources' folder.
set -u
program=$1 sources=$2
. "$(dirname "$0")/expect.sh"
cat >"$folder/pid.json" <<'END'
{"kind": "fopid", "kp": 0.3, "ki": 0.5, "kd": 0.02, "integral_order": 0.9, "derivative_order": 0.7,
 "filter_s": 0.01, "sample_time_s": 0.001, "low": -2, "high": 2, "setpoint_weight": 0.8}
END
echo '{"kind": "fopid", "kp": 0.3, "ki": 0.5, "kd": 0.001, "sample_time_s": 0.001, "low": -2, "high": 2}' >"$folder/whole.json"
echo '{"kind": "fopid", "kp": 0.3, "ki": 0.5, "integral_order": 0.8, "sample_time_s": 0.001, "low": -2, "high": 2}' >"$folder/pi.json"
echo '{"kind": "fopid", "kp": 0.3}' >"$folder/broken.json"
expect 2 "broken.json: expected the field sample_time_s" generate --controller "$folder/broken.json" --out "$folder/no.h"
expect 2 "--out: expected a file to write" generate --controller "$folder/pid.json"
expect 2 "--controller: expected --out" generate --controller "$folder/pid.json" --kernel ring_plain_f32 --out "$folder/no.h"
expect 2 "--order is required" generate --kernel ring_plain_f32 --taps 3 --out "$folder/no.h"
expect 2 "--core: expected --verify" generate --controller "$folder/pid.json" --core m7-ideal --out "$folder/no.h"
expect 2 "nosuch: no such core" generate --controller "$folder/pid.json" --verify --core nosuch --out "$folder/no.h"
expect 2 "--json: expected --controller or --model beside it" generate --order 0.5 --kernel ring_plain_f32 --taps 3 --json "$folder/no.json" --out "$folder/no.h"
# Ten times the gains: no header of a loop that grows, and none of a plant that does by itself.
sed 's/"kp": 0.3, "ki": 0.5/"kp": 3, "ki": 5/' "$folder/pid.json" >"$folder/ten.json"
echo '{"kind": "fotf", "denominator": [{"coefficient": 1, "order": 1}, {"coefficient": -1, "order": 0}]}' >"$folder/growing.json"
plant=$sources/drive/models/niopdt.json
expect 2 "ten.json: expected a stable loop with $plant, sampled every 0.001 s, found 2 poles outside the unit circle" \
    generate --controller "$folder/ten.json" --plant "$plant" --out "$folder/no.h" --json "$folder/no.json"
expect 2 "growing.json: expected a plant that is stable or integrates, found 1 poles with a positive real part" \
    generate --controller "$folder/pid.json" --plant "$folder/growing.json" --out "$folder/no.h"
[ ! -e "$folder/no.json" ] || { echo "what a refused header was found to do was written"; failures=$((failures + 1)); }
[ ! -e "$folder/no.h" ] || { echo "a refused header was written"; failures=$((failures + 1)); }

expect 2 "--format: expected f32 or q31, found q15" generate --controller "$folder/pid.json" --format q15 --out "$folder/no.h"
expect 2 "--format q31: expected --input-scale, the full scale of set point and measured value" generate --controller "$folder/pid.json" --format q31 --out "$folder/no.h"
for scale in -2 0 inf nan; do
    expect 2 "--input-scale: expected a number above 0, found $scale" generate --controller "$folder/pid.json" --format q31 --input-scale "$scale" --out "$folder/no.h"
done
expect 2 "--input-scale: expected --format q31 beside it" generate --controller "$folder/pid.json" --input-scale 2 --out "$folder/no.h"
expect 2 "--format: expected --controller" generate --kernel ring_plain_f32 --order 0.5 --taps 3 --format q31 --out "$folder/no.h"
sed 's/, "low": -2, "high": 2//' "$folder/pid.json" >"$folder/open.json"
expect 2 "expected low and high in the controller's file" generate --controller "$folder/open.json" --format q31 --input-scale 2 --out "$folder/no.h"
[ ! -e "$folder/no.h" ] || { echo "a refused header in q31 was written"; failures=$((failures + 1)); }

# NAME DEFINITIONS: generates NAME.h under one prefix, compiles it here and for the target, and runs the loop. In the format $format.
format=f32
try() {
    options=
    [ $format = f32 ] || options="--format $format --input-scale 2"
    # shellcheck disable=SC2086 # several words
    expect 0 "here, compiled by cc: the library's" generate --controller "$folder/$1.json" $options --prefix pid --out "$folder/$1.h" --verify
    grep -q "not compared: \|on the emulated Cortex-M7: the library's" "$folder/said" || { echo "$1: the target is not told of"; failures=$((failures + 1)); }
    shift_name=$1
    shift
    for compiler in gcc clang; do
        command -v $compiler >/dev/null 2>&1 || continue
        if ! $compiler -std=c99 -D_GNU_SOURCE -O2 -Wall -Wextra -Wconversion -Werror -DHEADER="\"$shift_name.h\"" "$@" \
            -I"$folder" "$sources/tests/cli/controller_loop.c" -lm -o "$folder/run" 2>"$folder/compiled"; then
            echo "$compiler refuses $shift_name.h:"; head -n 10 "$folder/compiled"
            failures=$((failures + 1))
        elif ! "$folder/run" >"$folder/loop"; then
            echo "$compiler, $shift_name: expected a loop within 1e-4 of full memory, found:"; cat "$folder/loop"
            failures=$((failures + 1))
        else
            cat "$folder/loop"
        fi
    done
    number=float
    [ $format = f32 ] || number=int32_t
    printf '#include "%s.h"\nvoid step_all(pid_f32_instance *S, float *u);\nvoid step_all(pid_f32_instance *S, float *u) { *u = pid_step_f32(S, *u, 0.0F); pid_start_f32(S, 0.0F, 0.0F, *u); pid_set_gains_f32(S, 1.0F, 1.0F, 1.0F); }\n' "$shift_name" |
        sed "/step_all/{s/float/$number/g; s/_f32/_$format/g; s/\([01]\)\.0F/\1/g}" >"$folder/unit.c"
    for line in "arm-none-eabi-gcc -std=c99 -mcpu=cortex-m7 -mfpu=fpv5-sp-d16 -mfloat-abi=hard" "g++ -x c++"; do
        command -v ${line%% *} >/dev/null 2>&1 || continue
        $line -O2 -Wall -Wextra -Wconversion -Werror -c "$folder/unit.c" -o "$folder/unit.o" ||
            { echo "$line refuses $shift_name.h"; failures=$((failures + 1)); }
    done
}

try_with() {
    name=$1 kd=$2 lambda=$3 mu=$4 filter=$5 weight=$6
    shift 6
    set -- "$name" -DKP=0.3 -DKI=0.5 "-DKD=$kd" "-DLAMBDA=$lambda" "-DMU=$mu" "-DFILTER=$filter" "-DWEIGHT=$weight" "$@"
    try "$@"
}
try_all() {
    try_with pid 0.02 0.9 0.7 0.01 0.8 "$@"
    try_with pi 0 0.8 1 0 1 "$@"
    try_with whole 0.001 1 1 0 1 "$@"
}
try_all
format=q31
try_all -DQ31
# The other core, where its board was built.
expect 0 "compiled by cc" generate --controller "$folder/pid.json" --format q31 --input-scale 2 --prefix pid --out "$folder/pid.h" --verify --core cortex-m4-zerowait
grep -q "not compared: \|on the emulated Cortex-M4: the library's" "$folder/said" || { echo "q31: the Cortex-M4 is not told of"; failures=$((failures + 1)); }

# What a step costs, where there is a board: bytes of the state as the compiler here has them, beside an integer PID.
expect 0 "compiled by cc" generate --controller "$folder/pid.json" --prefix pid --out "$folder/cost.h" --verify --json "$folder/cost.json"
if ! grep -q "not compared: " "$folder/said"; then
    grep -q "integer PID, the same gains .* to " "$folder/said" || { echo "no integer PID's cost is told"; failures=$((failures + 1)); }
    cat >"$folder/size.c" <<'END'
#include <stdio.h>
#include "cost.h"
int main(void) { return printf("\"state_bytes\": %lu,\n", (unsigned long)sizeof(pid_f32_instance)) < 0; }
END
    cc -I"$folder" "$folder/size.c" -lm -o "$folder/size" && "$folder/size" >"$folder/size.txt" && grep -qF -f "$folder/size.txt" "$folder/cost.json" ||
        { echo "the state's bytes are not $(cat "$folder/size.txt")"; failures=$((failures + 1)); }
fi
# An integer PID has none beside it.
expect 0 "compiled by cc" generate --controller "$folder/whole.json" --prefix pid --out "$folder/cost.h" --verify
! grep -q "integer PID, the same gains" "$folder/said" || { echo "an integer PID stands beside itself"; failures=$((failures + 1)); }

# A compiler that computes something else, and one that refuses.
mkdir "$folder/bin"
real=$(command -v cc) usual=$PATH
# With the usual path again: a cache of compilers looks for the compiler there, and would find this one.
printf '#!/bin/sh\nfor word; do case $word in *check.c) sed -i "s/kp = 0.3F/kp = 0.25F/" "${word%%check.c}pid.h" ;; esac; done\nexec env PATH="%s" %s "$@"\n' "$usual" "$real" >"$folder/bin/cc"
chmod +x "$folder/bin/cc"
PATH=$folder/bin:$PATH
expect 1 "changed.h: expected the bits of the library's float stepper, found others here" \
    generate --controller "$folder/pid.json" --prefix pid --out "$folder/changed.h" --verify
printf '#!/bin/sh\nexit 1\n' >"$folder/bin/cc"
expect 1 "this machine's C compiler refuses" generate --controller "$folder/pid.json" --prefix pid --out "$folder/refused.h" --verify
PATH=$usual

# The margins are told, and stand in the file and in the header's comment.
said='gain margin 2.3 at 1.44 rad/s, phase margin 68.7 degrees (crossover 0.499 rad/s), largest |S| 1.841 at 1.27 rad/s.'
expect 0 "$said" generate --controller "$folder/pid.json" --plant "$plant" --out "$folder/certified.h" --json "$folder/said.json"
grep -qF " * $said" "$folder/certified.h" || { echo "the margins are not in the header"; failures=$((failures + 1)); }
grep -q '"phase_margin_deg": 68.72' "$folder/said.json" || { echo "the margins are not in the file"; failures=$((failures + 1)); }
[ "$failures" -eq 0 ]
