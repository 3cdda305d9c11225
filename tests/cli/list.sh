#!/bin/sh
# list: a line each, the name first. Arguments: the glsum program, the source folder.
set -u
program=$1
source=$2
. "$(dirname "$0")/expect.sh"
expect 2 "expected kernels, orders, cores, signals or effects" list
expect 2 "kernals" list kernals
# names WORD: as a file for comparison
names() {
    expect 0 "" list "$1"
    sed 's/ .*//' "$folder/said" | LC_ALL=C sort >"$folder/$1"
    grep -vE '^[^ ]+ +[^ ].*$' "$folder/said" && { echo "list $1: expected a name and what it is on each line"; failures=$((failures + 1)); }
}
same() { diff "$folder/$1" "$folder/expected" || { echo "list $1"; failures=$((failures + 1)); }; }
names kernels
LC_ALL=C sort "$source/docs/measured/kernels" >"$folder/expected"
same kernels
names cores
ls "$source/qemu/cores" | sed -n 's/^\([^_].*\)\.toml$/\1/p' | LC_ALL=C sort >"$folder/expected"
same cores
names signals
printf '%s\n' step ramp sine1 sine5 sine50 noise drive | LC_ALL=C sort >"$folder/expected"
same signals
names orders
printf '%s\n' 0.2 0.3 0.5 0.7 0.9 0.98319 1.5 1.9909 -0.5 | LC_ALL=C sort >"$folder/expected"
same orders
names effects
sed -n 's/^EFFECT(\([a-z0-9_]*\)).*/\1/p' "$source/gap/drive/effects.def" | LC_ALL=C sort >"$folder/expected"
same effects
[ "$failures" -eq 0 ]
