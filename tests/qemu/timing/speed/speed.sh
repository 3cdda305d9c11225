#!/bin/sh
# speed.sh BUILD_DIRECTORY [CORE...]: executed instructions a second of CPU time, without a plugin and with the timing model on
# each core (default: stm32f746-itcm stm32f746-flash stm32h747-axi). CPU time of one thread: other work on the machine
# does not count. Exit 1 when a core falls below 30 million.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../../.." && pwd)
[ $# -ge 1 ] || { echo "usage: speed.sh BUILD_DIRECTORY [CORE...]" >&2; exit 2; }
plugin=$(cd "$1" && pwd)/qemu/glsum_plugin.so
shift
[ $# -gt 0 ] || set -- stm32f746-itcm stm32f746-flash stm32h747-axi
[ -f "$plugin" ] || { echo "speed.sh: $plugin is not built" >&2; exit 3; }
for tool in arm-none-eabi-gcc qemu-system-arm; do
    command -v "$tool" >/dev/null || { echo "speed.sh: $tool: not found" >&2; exit 3; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
calls=20000
arm-none-eabi-gcc -nostdlib -mcpu=cortex-m7 -mthumb -Wa,--defsym,calls=$calls \
    -Wl,-Ttext=0x100 -Wl,--section-start=.vectors=0 -o "$work/loops.elf" "$here/loops.S" 2>"$work/said" || { cat "$work/said" >&2; exit 3; }
address=$(arm-none-eabi-nm "$work/loops.elf" | sed -n 's/^\([0-9a-f]*\) T timed$/\1/p')
printf '%d\n' "0x$address" >"$work/watch"

# CPU seconds of the emulator in $seconds.
run() {
    ( GLSUM_QEMU_PLUGIN=$1 "$root/targets/mps2-an500/emulate" "$work/loops.elf" >"$work/said" 2>&1 || { cat "$work/said" >&2; exit 3; }
      times >"$work/times" )
    seconds=$(sed -n '2s/ .*//p' "$work/times" | awk -F'[ms]' '{ print $1 * 60 + $2 }')
}
run ''
bare=$seconds
status=0
for core in "$@"; do
    printf 'folder %s\ncore %s - - 1 -\n' "$root/qemu/cores" "$core" >"$work/request"
    run "$plugin,watch=$work/watch,timing=$work/request,times=$work/log"
    instructions=$(awk '/^calls/ { n += $2 * $4 } END { print n }' "$work/log")
    awk -v core="$core" -v n="$instructions" -v bare="$bare" -v s="$seconds" 'BEGIN {
        printf "%-24s %6.1f million instructions, %6.2f s: %6.1f million a second (without the model %.2f s)\n",
            core, n / 1e6, s, n / 1e6 / s, bare
        exit n / 1e6 / s < 30 }' || status=1
done
exit $status
