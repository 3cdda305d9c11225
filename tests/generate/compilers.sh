#!/bin/sh
# Headers of every kernel that can be generated: no warning, and the kernel's bits, with every compiler that is here, as C
# and as C++, at several optimisations and without -ffp-contract=off, on this machine and on the emulated target.
# Arguments: make_headers, the source folder, the build folder of the emulated board.
set -u
make_headers=$1
source=$2
board=$3
here=$source/tests/generate
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() { echo "$*"; failures=$((failures + 1)); }
warnings="-Wall -Wextra -Wpedantic -Wconversion -Werror"
"$make_headers" "$folder" >/dev/null || { echo "make_headers failed"; exit 1; }

# Whether this machine fuses: then a product fused with an addition would be seen.
fused=
grep -qw fma /proc/cpuinfo 2>/dev/null && [ "$(uname -m)" = x86_64 ] && fused=-mfma

on_host() {
    compiler=$1
    shift
    command -v "$compiler" >/dev/null 2>&1 || return 0
    if ! "$compiler" $warnings "$@" $fused "$folder/all.c" "$here/main.c" -lm -o "$folder/program" >"$folder/said" 2>&1; then
        fail "$compiler $*: $(grep -m 3 -E 'error|warning' "$folder/said")"
    elif ! "$folder/program" >"$folder/said"; then
        fail "$compiler $* $fused: $(head -n 3 "$folder/said")"
    else
        echo "$compiler $* $fused: $(tail -n 1 "$folder/said")"
    fi
}
on_host gcc -std=c99 -O0
on_host gcc -std=c99 -O3
on_host g++ -std=c++11 -x c++ -Os
on_host clang -std=c99 -O2 -ffp-contract=fast
on_host clang++ -std=c++17 -x c++ -O0

# A build with reordered sums is refused, not wrong.
echo '#include "g60.h"' >"$folder/fast.c"
gcc -std=c99 -ffast-math -fsyntax-only "$folder/fast.c" >"$folder/said" 2>&1 && fail "-ffast-math is not refused"
grep -q 'compile without it' "$folder/said" || fail "expected -ffast-math to be named; found $(head -n 2 "$folder/said")"

core="-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16"
on_target() {
    arm-none-eabi-gcc -std=c99 $warnings $core "$@" -c "$folder/all.c" -o "$folder/all.o" >"$folder/said" 2>&1 &&
        arm-none-eabi-g++ -std=c++20 -fno-exceptions -fno-rtti $core -O2 -I"$source" -I"$source/targets" -I"$source/kernels" -nostartfiles \
            -T "$source/targets/mps2-an500/memory.ld" -T "$source/targets/cortex-m7/sections.ld" \
            "$source/targets/firmware/verify.cpp" "$folder/all.o" "$board/targets/libboard.a" -lm -o "$folder/all.elf" \
            >>"$folder/said" 2>&1 ||
        { fail "arm-none-eabi-gcc $*: $(grep -m 3 -E 'error|warning' "$folder/said")"; return; }
    "$source/targets/mps2-an500/emulate" "$folder/all.elf" >"$folder/rows" 2>&1 || fail "$* on the target: $(tail -n 2 "$folder/rows")"
    good=$(grep -c '^row [0-9]* 0$' "$folder/rows")
    total=$(sed -n 's/^end //p' "$folder/rows")
    echo "arm-none-eabi-gcc $*: $good of $total headers have the kernel's bits"
    [ "$good" = "$total" ] || fail "$* on the target: $(grep -v ' 0$' "$folder/rows" | head -n 3)"
}
if command -v arm-none-eabi-gcc >/dev/null 2>&1 && [ -e "$board/targets/libboard.a" ]; then
    on_target -O0
    on_target -O3
    on_target -Os
elif [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ]; then
    fail "the emulated board's firmware is missing"
fi
[ "$failures" -eq 0 ]
