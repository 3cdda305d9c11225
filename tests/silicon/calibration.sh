#!/bin/sh
# calibration.sh PROGRAM FIRMWARE: the timing model against the measured rows of others that it was calibrated on (rows.sh), within
# the bounds of bounds.txt. 77 where those programs, the compiler or the emulator are not there.
set -u
program=$1 firmware=$2
here=$(cd "$(dirname "$0")" && pwd)
if ! command -v qemu-system-arm >/dev/null 2>&1 || [ ! -e "$firmware/targets/libboard.a" ]; then
    echo "no emulator, or no firmware"
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
sh "$here/rows.sh" "$firmware" "$folder" || exit
failures=0
# The number of a field of the fit, in % where it is a share.
percent() { sed -n "s/^ \"$1\": \([-0-9.e]*\),\{0,1\}\$/\1/p" "$folder/fit.json" | awk '{print 100 * $1}'; }
compiler=$(arm-none-eabi-g++ -dumpversion | cut -d . -f 1)
while read -r group judged median worst inside half_width; do
    case $group in '#'*) continue ;; esac
    rm -f "$folder/fit.json"
    "$program" silicon --rows "$folder/$group.csv" --json "$folder/fit.json" >"$folder/said" 2>&1
    tail -n 3 "$folder/said" | sed "s/^/$group: /"
    case $judged in
        any | "$compiler") ;;
        *) echo "$group: told, not judged: by GCC $compiler; its bounds are of GCC $judged"; continue ;;
    esac
    echo "$(percent median_error) $median $(percent worst_error) $worst $inside $(percent inside_band) $(percent median_half_width) $half_width" |
        awk 'NF != 8 {exit 1} {exit !($1 <= $2 && ($3 < 0 ? -$3 : $3) <= $4 && $5 <= $6 && $7 <= $8)}' || {
        echo "$group: expected a median error of at most $median %, a worst one of $worst %, $inside % inside, a half-width of $half_width %"
        failures=$((failures + 1))
    }
done <"$here/bounds.txt"
[ "$failures" -eq 0 ]
