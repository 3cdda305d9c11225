#!/bin/sh
# The kernels use no heap, I/O, exceptions or RTTI: what their libraries may leave to the linker is listed here.
# Arguments: the host's library, the build folder of the firmware.
set -u
failures=0

# check NM LIBRARY ALLOWED: undefined symbols that no object of the library defines and the pattern does not allow.
check() {
    found=$("$1" -C --undefined-only -f posix "$2" 2>/dev/null | sed 's/ [Uw] .*//; /:$/d' | sort -u)
    defined=$("$1" -C --defined-only -f posix "$2" 2>/dev/null | sed 's/ [A-Za-z] .*//; /:$/d' | sort -u)
    extra=$(printf '%s\n' "$found" | grep -vxF "$defined" | grep -vxE "$3" | grep -v '^ *$')
    if [ -n "$extra" ]; then
        echo "$2: expected no symbols but $3; found also:"
        echo "$extra"
        failures=$((failures + 1))
    fi
}

# fma, fmaf: the fused kernels on a machine without the instruction. __cpu_*, __cxa_guard_*: GCC's and xsimd's choice
# of the instruction set.
check nm "$1" 'mem(cpy|move|set)|fmaf?|__cpu_(model|indicator_init|features2)|__cxa_guard_(acquire|release)|__stack_chk_fail|_GLOBAL_OFFSET_TABLE_'
target=$2/kernels/libglsum.a
[ -f "$target" ] && check arm-none-eabi-nm "$target" 'mem(cpy|move|set)|__aeabi_[a-z0-9]+'
[ "$failures" -eq 0 ]
