#!/bin/sh
# choose and generate for a derivative within so many percent: what is refused, and the header's own response.
# Arguments: the glsum program, the sources' folder, the build folder of the emulated board's firmware.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
at="--order 0.5 --step-s 0.001 --target m7"
half="$at --derivative-error 5% --band 0.05..80 --step-until 60"
expect 2 "--derivative-error: expected a share above 0, as in 5%, found five" choose $at --derivative-error five --band 1..2
expect 2 "found -5%" choose $at --derivative-error=-5% --band 1..2
expect 2 "expected --band, --step-until or both" choose $at --derivative-error 5%
expect 2 "only with --derivative-error" choose $at --max-error 0.1 --band 1..2
expect 2 "only with --derivative-error" choose $at --max-error 0.1 --step-until 2
expect 2 "which speak of the sum; expected one" choose $at --max-error 0.1 --derivative-error 5% --band 1..2
expect 2 "expected two rising frequencies in Hz, as in 0.05..80, found 80..0.05" choose $at --derivative-error 5% --band 80..0.05
expect 2 "found 0..80" choose $at --derivative-error 5% --band 0..80
expect 2 "found 7" choose $at --derivative-error 5% --band 7
expect 2 "half the sampling rate, 500 Hz, found 600" choose $at --derivative-error 5% --band 1..600
expect 2 "found 1e-06 Hz" choose $at --derivative-error 5% --band 1e-6..1
expect 2 "expected 10 to 5e+07 samples, found 5" choose $at --derivative-error 5% --step-until 0.005
expect 2 "of a step is 0" choose --order 1 --step-s 0.001 --target m7 --derivative-error 5% --step-until 1
expect 2 "expected no --kernel beside it" generate $at --derivative-error 5% --band 1..2 --kernel ring_plain_f32 --taps 9 --out "$folder/no.h"
expect 1 "misses --derivative-error by" choose $at --derivative-error 0.3% --band 5..80 --step-until 0.1 --design charef
expect 1 "misses --max-bytes by" choose $at --derivative-error 5% --band 5..80 --step-until 0.1 --max-bytes 40 --json "$folder/none.json"
grep -q '"instead": "--step-until 0.1 alone"' "$folder/none.json" || { echo "expected what would do"; failures=$((failures + 1)); }
expect 0 "a whole order: the sum has 2 weights" choose --order 1 --step-s 0.001 --target m7 --derivative-error 5% --band 0.5..40
expect 0 "a whole order: the sum is that of all samples" choose --order -1 --step-s 0.001 --target m7 --derivative-error 5% --band 0.5..40
expect 2 "--order: " choose --order half --step-s 0.001 --target m7 --derivative-error 5% --band 0.5..40
expect 2 "expected fitted, oustaloup or charef, found crone" choose $at --derivative-error 5% --band 1..2 --design crone
expect 2 "tuned to a --band, and there is none" choose $at --derivative-error 5% --step-until 2 --design charef
expect 2 "no whole number, found 1" choose --order 1 --step-s 0.001 --target m7 --derivative-error 5% --band 1..2 --design oustaloup
expect 2 "only with --derivative-error" choose $at --max-error 0.1 --design charef
expect 2 "and --plot: only with --derivative-error" choose $at --max-error 0.1 --plot "$folder/picture.png"
if command -v gnuplot >/dev/null 2>&1; then
    expect 0 "certified  within" choose $half --json "$folder/half.json" --plot "$folder/picture.png"
    [ -s "$folder/picture.png" ] && [ -s "$folder/picture.svg" ] || { echo "expected a picture"; failures=$((failures + 1)); }
else
    expect 0 "certified  within" choose $half --json "$folder/half.json"
fi
grep -q '"band_hz"' "$folder/half.json" && grep -q '"step_error"' "$folder/half.json" && grep -q '"factor"' "$folder/half.json" ||
    { echo "expected band, step and factor in the answer"; failures=$((failures + 1)); }
expect 0 "measured" generate $half --max-bytes 200 --out "$folder/half.h"
grep -q "within .* % from 0.05 to 80 Hz" "$folder/half.h" || { echo "the header does not say its band"; failures=$((failures + 1)); }
# By another's rule: the response of its header, over the band, is held the same way.
for rule in oustaloup charef; do
    expect 0 "measured" generate $at --derivative-error 5% --band 0.5..80 --design $rule --prefix half --out "$folder/$rule.h"
    grep -q "rule, tuned to the band" "$folder/$rule.h" || { echo "the header does not name its rule"; failures=$((failures + 1)); }
    # Two of one prefix are told apart by it.
    grep -iq "^#define HALF_.*_DESIGN .*$rule's filter, tuned to the band\"" "$folder/$rule.h" ||
        { echo "the header's design does not name its rule: $(grep -m 1 _DESIGN "$folder/$rule.h")"; failures=$((failures + 1)); }
done
asked="0.5 0.001 0.05 80 60"
response_of() {  # COMPILER; the response is in $folder/response
    if [ ! -s "$folder/response" ] || ! awk '$2 > 0.05 || $4 > 0.05 || $2 < 0.01 || $4 < 0.01 { exit 1 }' "$folder/response"; then
        echo "$1: the header's response:"; cat "$folder/response" "$folder/made"
        failures=$((failures + 1))
    fi
}
for compiler in gcc clang; do
    command -v $compiler >/dev/null 2>&1 || continue
    : >"$folder/response"
    # shellcheck disable=SC2086
    $compiler -std=c99 -D_GNU_SOURCE -O2 -Wall -Wextra -Werror -I"$folder" "$2/tests/cli/derivative_response.c" -lm -o "$folder/run" >"$folder/made" 2>&1 &&
        "$folder/run" $asked >"$folder/response"
    response_of $compiler
    cp "$folder/response" "$folder/response.host"
done
# On the emulated Cortex-M7, whose board hands no words to main; the sines' doubles by a core that has them.
if command -v arm-none-eabi-gcc >/dev/null 2>&1 && command -v qemu-system-arm >/dev/null 2>&1 && [ -e "$3/targets/libboard.a" ]; then
    {
        printf '#define main taken\n#include "%s/tests/cli/derivative_response.c"\n#undef main\n' "$2"
        printf 'int main(void) { char *words[] = {"", "%s"}; return taken(6, words); }\n' "$(echo "$asked" | sed 's/ /", "/g')"
    } >"$folder/on_board.c"
    : >"$folder/response"
    arm-none-eabi-gcc -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16 -std=c99 -D_GNU_SOURCE -O2 -Wall -Wextra -Werror -I"$folder" \
        "$folder/on_board.c" -nostartfiles -T "$2/targets/mps2-an500/memory.ld" -T "$2/targets/cortex-m7/sections.ld" \
        -Wl,--defsym=firmware_main=main -Wl,--start-group "$3/targets/libboard.a" -lm -lc -lgcc -Wl,--end-group \
        -o "$folder/on_board.elf" >"$folder/made" 2>&1 &&
        timeout 300 qemu-system-arm -machine mps2-an500 -display none -semihosting-config enable=on,target=native \
            -kernel "$folder/on_board.elf" >"$folder/response" 2>>"$folder/made" </dev/null
    response_of arm-none-eabi-gcc
    cmp -s "$folder/response" "$folder/response.host" || { echo "on the Cortex-M7 the response is another:"; cat "$folder/response"; failures=$((failures + 1)); }
elif [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ]; then
    echo "no firmware was built"
    exit 1
fi
[ "$failures" -eq 0 ]
