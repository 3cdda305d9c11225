#!/bin/sh
# The check of the checker: an object with a double-precision instruction fails, one without passes.
# Argument: the check.
set -u
check=$1
command -v arm-none-eabi-gcc >/dev/null 2>&1 || { echo "no arm-none-eabi-gcc"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
echo 'double product(double a, double b) { return a * b; } float single(float a, float b) { return a * b; }' >"$folder/source.c"
flags="-O2 -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -c $folder/source.c"
arm-none-eabi-gcc $flags -mfpu=fpv5-d16 -o "$folder/double.o" || exit 1
arm-none-eabi-gcc $flags -mfpu=fpv5-sp-d16 -o "$folder/single.o" || exit 1
"$check" "$folder/double.o" >"$folder/said" 2>&1
[ $? -eq 1 ] && grep -q 'vmul.f64' "$folder/said" || { echo "expected status 1 naming vmul.f64; found:"; cat "$folder/said"; exit 1; }
"$check" "$folder/single.o" || { echo "expected status 0 without a double-precision instruction"; exit 1; }
"$check" "$folder/source.c" >/dev/null 2>&1
[ $? -eq 2 ] || { echo "expected status 2 for a file that is no ELF"; exit 1; }
