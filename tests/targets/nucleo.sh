#!/bin/sh
# The programs for the real board, which no test can run: that they build, for every placement, and that what a chip would
# trip over is right in the ELF: vector table, memory regions, entry, no double-precision instruction, the settings asked for.
# Argument: the project's folder.
set -u
source=$1
fail() { echo "$*"; failures=$((failures + 1)); }
failures=0
for tool in arm-none-eabi-gcc arm-none-eabi-readelf arm-none-eabi-objdump; do
    command -v $tool >/dev/null 2>&1 || { echo "no $tool"; [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ] && exit 1; exit 77; }
done
build=$source/build/nucleo-f746zg
mkdir -p "$build"
programs=$build/targets
cd "$source" || exit 1

# build OPTION=VALUE...: all options that are not named as by default.
build() {
    set -- -DGLSUM_CODE=flash_cached -DGLSUM_FLASH_PATH=axi -DGLSUM_ART=ON -DGLSUM_DATA=dtcm -DGLSUM_DATA_CACHE=ON \
        -DGLSUM_MAINTENANCE=OFF -DGLSUM_OUTPUT=serial "$@"
    cmake --preset nucleo-f746zg "$@" >"$build/test.log" 2>&1 && cmake --build --preset nucleo-f746zg >>"$build/test.log" 2>&1 ||
        { fail "$*: does not build: $(grep -m 3 -E 'rror|FAILED' "$build/test.log")"; return 1; }
}
# value ELF SYMBOL: its address, in lower-case hex
value() { arm-none-eabi-nm "$1" | sed -n "s/^\([0-9a-f]*\) . $2\$/\1/p"; }
# between HEX LOWEST END WHAT
between() {
    [ -n "$1" ] && [ $((0x$1)) -ge $(($2)) ] && [ $((0x$1)) -lt $(($3)) ] || fail "$4: expected from $2 to below $3, found ${1:-nothing}"
}
# word ELF NUMBER: of the vector table, as a number would be written
word() {
    arm-none-eabi-objdump -s -j .vectors "$1" | sed -n 's/^ [0-9a-f]* \([0-9a-f ]*\)  .*/\1/p' | tr -d ' \n' |
        cut -c $((8 * $2 + 1))-$((8 * $2 + 8)) | sed 's/\(..\)\(..\)\(..\)\(..\)/\4\3\2\1/'
}

flash=0x08000000 flash_end=0x08100000
check() {  # ELF CODE CODE_END STACK_TOP
    elf=$1 code=$2 code_end=$3 stack_top=$4
    between "$(value "$elf" link_vectors)" "$code" $((code + 1)) "$elf: the vector table"
    [ "$(word "$elf" 0)" = "$stack_top" ] || fail "$elf: expected the stack's top $stack_top in the vector table, found $(word "$elf" 0)"
    reset=$(word "$elf" 1)
    between "$reset" "$code" "$code_end" "$elf: the reset vector"
    [ $((0x$reset % 2)) -eq 1 ] || fail "$elf: expected a Thumb address as reset vector, found $reset"
    [ $((0x$reset - 1)) -eq $((0x$(value "$elf" reset_handler))) ] || fail "$elf: the reset vector is not reset_handler"
    entry=$(arm-none-eabi-readelf -h "$elf" | sed -n 's/.*Entry point address: *0x//p')
    [ $((0x$entry)) -eq $((0x$reset)) ] || fail "$elf: expected the entry $reset, found $entry"
    for vector in 2 3 4 5 6 11 15; do
        between "$(word "$elf" $vector)" "$code" "$code_end" "$elf: vector $vector"
    done
    # What is loaded lies in the flash, and ends there.
    arm-none-eabi-readelf -lW "$elf" | awk '$1 == "LOAD" {print $4, $5}' >"$build/loads"
    while read -r physical size; do
        [ $((size)) -eq 0 ] && continue
        [ $((physical)) -ge $((code)) ] && [ $((physical + size)) -le $((code_end)) ] ||
            fail "$elf: $size bytes at $physical are not in the flash"
    done <"$build/loads"
    "$source/targets/check_elf" "$elf" || failures=$((failures + 1))
    arm-none-eabi-readelf -A "$elf" | grep -q 'Tag_CPU_arch: v7E-M' || fail "$elf: expected v7E-M"
    arm-none-eabi-readelf -A "$elf" | grep -q 'Tag_FP_arch: FPv5' || fail "$elf: expected the FPv5 unit"
}

if build; then
    for program in silicon selftest example; do
        check "$programs/$program.elf" $flash $flash_end 20010000
    done
    elf=$programs/silicon.elf
    between "$(value "$elf" glsum_silicon_shift_fir_q31)" $flash $flash_end "the loops in flash"
    # The lock of the cycle counter is released, by its key.
    arm-none-eabi-objdump -d "$elf" | grep -qiE 'c5acce55|#52821|0xce55|#50604|0xc5ac' || fail "expected the key 0xC5ACCE55"
    grep -aq '216mhz_7ws_axi_art_data_cache' "$elf" || fail "expected the setup's word in the program"
fi
if build -DGLSUM_CODE=itcm; then
    elf=$programs/silicon.elf
    check "$elf" $flash $flash_end 20010000
    between "$(value "$elf" glsum_silicon_shift_fir_q31)" 0 0x4000 "the loops in ITCM"
    step=$(arm-none-eabi-nm "$elf" | sed -n 's/^\([0-9a-f]*\) . _ZN5glsum3SumINS_4RingENS_5PlainENS_3F32EE4stepE.*/\1/p')
    between "$step" 0 0x4000 "a kernel in ITCM"
    between "$(value "$elf" link_itcm_source)" $flash $flash_end "ITCM's content"
    [ $((0x$(value "$elf" link_itcm_end))) -gt 4096 ] || fail "expected all kernels in ITCM"
    # With what they call: a loop that stayed in flash would be measured as if it had not.
    for part in dot_smlal dot_smlald dot_floats horner_floats; do
        between "$(arm-none-eabi-nm "$elf" | sed -n "s/^\([0-9a-f]*\) . _ZN5glsum3dspL[0-9]*${part}E.*/\1/p")" 0 0x4000 "$part in ITCM"
    done
fi
if build -DGLSUM_DATA=axi -DGLSUM_MAINTENANCE=ON; then
    check "$programs/silicon.elf" $flash $flash_end 20050000
    between "$(value "$programs/silicon.elf" link_bss_begin)" 0x20010000 0x20050000 "data in SRAM"
fi
if build -DGLSUM_FLASH_PATH=art -DGLSUM_OUTPUT=semihosting; then
    check "$programs/silicon.elf" 0x00200000 0x00300000 20010000
    arm-none-eabi-objdump -d "$programs/silicon.elf" | grep -q 'bkpt.*0x00ab' || fail "expected semihosting calls"
fi
cmake --preset nucleo-f746zg -DGLSUM_DATA=ram >"$build/test.log" 2>&1 && fail "expected GLSUM_DATA=ram to be refused"
grep -q 'GLSUM_DATA: expected one of dtcm;axi, found ram' "$build/test.log" || fail "expected the choices; found $(grep -m 1 GLSUM "$build/test.log")"
build || :
[ "$failures" -eq 0 ]
