#!/bin/sh
# generate --model: what is refused, and the header's response beside the exact one of plant (12).
# Arguments: the glsum program, the sources' folder.
set -u
program=$1 sources=$2
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
plant=$sources/drive/models/niopdt.json
sed '/sample_time_s/d' "$plant" >"$folder/timeless.json"
echo '{"kind": "fotf", "denominator": [{"coefficient": 1, "order": 1}, {"coefficient": -1, "order": 0}], "sample_time_s": 0.001}' >"$folder/growing.json"
expect 2 "--out: expected a file to write" generate --model "$plant"
expect 2 "--model: expected --out" generate --model "$plant" --kernel ring_plain_f32 --out "$folder/no.h"
expect 2 "--model: expected --out" generate --model "$plant" --plant "$plant" --out "$folder/no.h"
expect 2 "nosuch: no such core" generate --order 0.5 --kernel "ring_*" --taps 20 --verify --core nosuch
expect 2 "--core: expected --verify" generate --model "$plant" --core m7-ideal --out "$folder/no.h"
expect 2 "nosuch: no such core" generate --model "$plant" --verify --core nosuch --out "$folder/no.h"
expect 2 "nosuch.json: cannot read" generate --model "$folder/nosuch.json" --out "$folder/no.h"
expect 2 "expected a stable model" generate --model "$folder/growing.json" --out "$folder/no.h"
expect 2 "--prefix: expected letters" generate --model "$plant" --prefix 1-2 --out "$folder/no.h"
expect 1 "--max-error: expected 1e-09 to be kept; the nearest, modesbdf2_" generate --model "$plant" --max-error 1e-9 --samples 2000 --out "$folder/no.h"
grep -q sample_time_s "$folder/timeless.json" && fail "expected a model without a sample time"
expect 2 "timeless.json: no sample_time_s; expected one there, or --step-s" generate --model "$folder/timeless.json" --out "$folder/no.h"
expect 2 "--format: expected f32 or q31, found f64" generate --model "$plant" --format f64 --out "$folder/no.h"
expect 2 "--format q31: expected --input-scale, the full scale of the input" generate --model "$plant" --format q31 --out "$folder/no.h"
expect 2 "--input-scale: expected a number above 0, found 0" generate --model "$plant" --format q31 --input-scale 0 --out "$folder/no.h"
expect 2 "--input-scale: expected a number above 0, found -1" generate --model "$plant" --format q31 --input-scale -1 --out "$folder/no.h"
expect 2 "--input-scale: expected --format q31 beside it" generate --model "$plant" --input-scale 1 --out "$folder/no.h"
[ ! -e "$folder/no.h" ] || fail "a refused header was written"

# HEADER LEAST MOST: compiled and run here, compiled for the target and as C++. In the format $format.
format=f32
try() {
    number=float define=
    [ $format = f32 ] || { number=int32_t define=-DQ31; }
    for compiler in gcc clang; do
        command -v $compiler >/dev/null 2>&1 || continue
        if ! $compiler -std=c99 -O2 -Wall -Wextra -Wpedantic -Wconversion -Werror $define -DHEADER="\"$1\"" -I"$folder" \
            "$sources/tests/cli/model_step.c" -o "$folder/run" 2>"$folder/compiled"; then
            fail "$compiler refuses $1: $(head -n 5 "$folder/compiled")"
        elif ! found=$("$folder/run") || ! awk -v y="$found" -v a="$2" -v b="$3" 'BEGIN { exit !(y >= a && y <= b) }'; then
            fail "$compiler, $1: expected $2 to $3 after 5 s, found $found"
        fi
    done
    printf '#include "%s"\nfloat one(plant_f32_instance *S, float u);\nfloat one(plant_f32_instance *S, float u) { return plant_step_f32(S, u); }\n' "$1" |
        sed "/one(/{s/float/$number/g; s/_f32/_$format/g}" >"$folder/unit.c"
    for line in "arm-none-eabi-gcc -std=c99 -mcpu=cortex-m7 -mfpu=fpv5-sp-d16 -mfloat-abi=hard" "g++ -x c++"; do
        command -v ${line%% *} >/dev/null 2>&1 || continue
        $line -O2 -Wall -Wextra -Wconversion -Werror -c "$folder/unit.c" -o "$folder/unit.o" || fail "$line refuses $1"
    done
}

# The exact response ends at 0.9977 (glsum paper).
expect 0 "here, compiled by cc: the library's" generate --model "$plant" --prefix plant --out "$folder/first.h" --verify --json "$folder/first.json"
grep -q "not compared: \|on the emulated Cortex-M7: the library's" "$folder/said" || fail "the target is not told of"
grep -q '"schema": "glsum-model-1"' "$folder/first.json" || fail "expected the schema glsum-model-1"
try first.h 0.9970 0.9984
expect 0 "modesbdf2_" generate --model "$folder/timeless.json" --step-s 0.001 --max-error 1e-4 --samples 100000 --prefix plant --out "$folder/second.h"
try second.h 0.9976 0.9978
expect 0 "fopdt.json in" generate --model "$sources/drive/models/fopdt.json" --out "$folder/fopdt.h" --prefix plant

format=q31
for core in stm32f746-itcm cortex-m4-zerowait; do
    expect 0 "here, compiled by cc: the library's" generate --model "$plant" --format q31 --input-scale 2 --prefix plant --out "$folder/fixed.h" --verify --core $core
    grep -q "not compared: \|on the emulated Cortex-M[47]: the library's" "$folder/said" || fail "q31: the target of $core is not told of"
done
try fixed.h 0.9970 0.9984
expect 0 "modesbdf2_plain_q31" generate --model "$plant" --max-error 1e-4 --samples 20000 --format q31 --input-scale 2 --prefix plant --out "$folder/second_q31.h"
try second_q31.h 0.9976 0.9978

# Another design under the same prefix is not left out in silence.
printf '#include "first.h"\n#include "second.h"\nint main(void) { return 0; }\n' >"$folder/two.c"
cc -std=c99 -I"$folder" "$folder/two.c" -o "$folder/two" 2>"$folder/compiled" && fail "two designs of one prefix were compiled"
grep -q "two designs of one prefix, .*; make one with another --prefix" "$folder/compiled" || fail "expected to be told of two designs, found: $(head -n 3 "$folder/compiled")"
[ "$failures" -eq 0 ]
