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
grep -q 'Runner-up' "$folder/b.h" || fail "expected the runner-up in the header"
# No header costs more than its kernel, whatever the rest of groups and the scale.
for design in '0.5 100' '0.98319 51' '-0.5 62'; do
    set -- $design
    expect 0 "the kernel's" generate --order "$1" --kernel '*' --taps "$2" --verify
    [ "$(grep -c "the kernel's" "$folder/said")" -ge 59 ] || fail "expected every kernel's header"
    # In software double GCC 14 saves up to six registers more around the calls of a whole sum.
    dearer=$(awk "/the kernel's/ && (\$6 > \$5 * (\$1 ~ /64\$/ ? 1.001 : 1) || \$9 > \$8)" "$folder/said")
    [ -z "$dearer" ] || fail "expected no header of more instructions or cycles than its kernel, found $dearer"
done
expect 0 "the kernel's" generate --order 0.5 --kernel 'nested_*' --taps 300 --verify
# The committed example, made again: all but where and by what it was made.
command=$(sed -n 's/^ \* Command: glsum //p' "$source/targets/example/half_derivative.h")
(cd "$folder" && mkdir -p targets/example && "$program" $command >/dev/null 2>&1) || fail "the example's command fails: $command"
same() { grep -v '^ \* \(glsum \|Errors and\|Cost: \|QEMU \|Measured cost\|Cost not\)' "$1/targets/example/half_derivative.h"; }
same "$source" >"$folder/committed"
same "$folder" >"$folder/made"
cmp -s "$folder/committed" "$folder/made" ||
    fail "the example's header is not what its command makes: $(diff "$folder/committed" "$folder/made" | head -n 4)"
[ "$failures" -eq 0 ]
