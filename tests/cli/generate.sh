#!/bin/sh
# generate: what it says and exits with; headers that cost no more than their kernels; the committed example is what its
# own command makes. Arguments: the glsum program, the source folder.
set -u
program=$1
source=$2
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
expect 0 "Example:" generate --help
expect 2 "--out" generate --order 0.5 --kernel ring_plain_f32 --taps 10
expect 2 "expected a budget" generate --order 0.5 --out "$folder/a.h"
expect 2 "--taps: expected 1 to 8000" generate --order 0.5 --kernel ring_plain_f32 --out "$folder/a.h"
expect 2 "no kernel is called ring_plain_f33" generate --order 0.5 --kernel ring_plain_f33 --taps 10 --out "$folder/a.h"
expect 2 "it needs the host's vector unit" generate --order 0.5 --kernel mirror_simd_f32 --taps 10 --out "$folder/a.h"
expect 2 "--prefix" generate --order 0.5 --kernel ring_plain_f32 --taps 10 --prefix 1a --out "$folder/a.h"
expect 2 "the coefficients do not fit the format" generate --order -1.9 --kernel mirror_smlad_q15 --taps 5000 --out "$folder/a.h"
[ ! -e "$folder/a.h" ] || fail "a refused header was written"
expect 0 "ring_plain_q15 with 10 taps in" generate --order 0.5 --kernel ring_plain_q15 --taps 10 --samples 50 --out "$folder/a.h"
expect 0 "taps in" generate --order 0.5 --step-s 0.001 --max-error 0.1 --target m7 --samples 60 --out "$folder/b.h" --verify
expect 0 "taps in" generate --order 0.5 --step-s 0.001 --max-error 0.05 --target m7 --signal step --samples 20000 --out "$folder/long.h"
grep -q 'over 20000 samples' "$folder/long.h" || fail "expected the header to name its record"
grep -q 'Runner-up' "$folder/b.h" || fail "expected the runner-up in the header"
# No header costs more than its kernel, whatever the rest of groups and the scale.
for design in '0.5 100' '0.98319 51' '-0.5 62'; do
    set -- $design
    expect 0 "the kernel's" generate --order "$1" --kernel '*' --taps "$2" --verify
    [ "$(grep -c "the kernel's" "$folder/said")" -ge 59 ] || fail "expected every kernel's header"
    # An instruction beside another costs nothing: by another compiler there may be some more, and in software double its place.
    costlier=$(awk "/the kernel's/ && (\$6 > 1.07 * \$5 || \$9 > \$8 * (\$1 ~ /64\$/ ? 1.002 : 1))" "$folder/said")
    [ -z "$costlier" ] || fail "expected no header of more cycles than its kernel, found $costlier"
done
expect 0 "the kernel's" generate --order 0.5 --kernel 'nested_*' --taps 300 --verify
# Of three taps, where a branch that goes another way weighs most.
expect 0 "the kernel's" generate --order 0.5 --kernel '*_f64' --taps 3 --verify
# The committed example, made again: all but where and by what it was made.
command=$(sed -n 's/^ \* Command: glsum //p' "$source/targets/example/half_derivative.h")
(cd "$folder" && mkdir -p targets/example && "$program" $command >/dev/null 2>&1) || fail "the example's command fails: $command"
same() { grep -v '^ \* \(glsum \|Errors and\|Cost: \|QEMU \|Measured cost\|Cost not\)' "$1/targets/example/half_derivative.h"; }
same "$source" >"$folder/committed"
same "$folder" >"$folder/made"
cmp -s "$folder/committed" "$folder/made" ||
    fail "the example's header is not what its command makes: $(diff "$folder/committed" "$folder/made" | head -n 4)"
# Two headers of one program: apart by their files' names; of one prefix only the same design.
for order in 0.5 -0.5; do
    expect 0 "with 20 taps" generate --order $order --kernel ring_plain_f32 --taps 20 --quick --out "$folder/of_$order.h"
    expect 0 "with 20 taps" generate --order $order --kernel ring_plain_f32 --taps 20 --quick --prefix same --out "$folder/same_$order.h"
done
cat >"$folder/two.c" <<'C'
#include <stdio.h>
#include "of_0.5.h"
#include "of_-0.5.h"
#include "same_0.5.h"
#include "same_0.5.h"
static of_0_5_f32_instance derivative;
static of__0_5_f32_instance integral;
static same_f32_instance same;
int main(void)
{
    float d = 0, i = 0, s = 0;
    int k;
    for (k = 0; k < 10; ++k) {
        d = of_0_5_step_f32(&derivative, 1.0F);
        i = of__0_5_step_f32(&integral, 1.0F);
        s = same_step_f32(&same, 1.0F);
    }
    printf("%.5f %.5f %d\n", (double)d, (double)i, d == s);
    return 0;
}
C
# Gamma(k + 1/2) / (Gamma(1/2) k!) and Gamma(k + 3/2) / (Gamma(3/2) k!) at k = 9
cc -std=c99 -Wall -Wextra -Werror -o "$folder/two" "$folder/two.c" 2>"$folder/said" && [ "$("$folder/two")" = "0.18547 3.52394 1" ] ||
    fail "two headers: expected 0.18547 3.52394 1, found $("$folder/two" 2>&1) $(cat "$folder/said")"
printf '#include "same_0.5.h"\n#include "same_-0.5.h"\n' >"$folder/clash.c"
# Warnings off (-w): what names the designs is no warning.
if cc -std=c99 -w -c -o "$folder/clash.o" "$folder/clash.c" 2>"$folder/said"; then fail "two designs of one prefix: expected an error"; fi
for design in 'message: same_f32 was included before as: ring_plain_f32, 20, v = 0.5, h = 0.001 s' \
    'error.*same_f32: two designs of one prefix.*ring_plain_f32, 20, v = -0.5, h = 0.001 s'; do
    grep -q "$design" "$folder/said" || fail "two designs of one prefix: expected $design, found $(cat "$folder/said")"
done
# Bounds are rounded up: an input reaches 0.00173273 of this design; a running sum's is of the record that the header speaks of.
expect 0 "with 2+7 taps" generate --order 0.5 --kernel modes_plain_f32 --taps 2+7 --out "$folder/modes.h"
grep -q 'full memory (5000 samples from rest): 0.00174$' "$folder/modes.h" || fail "expected 0.00174, found $(grep 'full memory' "$folder/modes.h")"
expect 0 "" generate --order -1 --kernel modessum_plain_f32 --taps 3 --quick --out "$folder/sum.h"
bound=$(sed -n 's/.*, over 1000 samples, rounding .* included: //p' "$folder/sum.h")
[ -n "$bound" ] && [ "$(echo "$bound" | awk '{print ($1 > 1e-5 && $1 < 0.2)}')" = 1 ] ||
    fail "running sum: expected a bound over 1000 samples, found $(grep included "$folder/sum.h")"
[ "$failures" -eq 0 ]
