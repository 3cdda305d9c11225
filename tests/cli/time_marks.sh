#!/bin/sh
# time --marks: stretches that a program of anybody's marks with two instructions, by our header or in its own words; marks that do
# not pair are told with their places.
# Arguments: the glsum program; the project's folder.
set -u
program=$1 source=$2
. "$(dirname "$0")/expect.sh"
. "$(dirname "$0")/../foreign/foreign.sh"
fail() { echo "$*"; failures=$((failures + 1)); }

cat >"$folder/marked.c" <<'C'
#include "glsum_mark.h"
#define KEEP __attribute__((noinline, noclone))
volatile int sink;
int table[32];
KEEP int total(int n) { int s = 0; for (int i = 0; i < n; i++) s += table[i]; return s; }
KEEP void filter(int n) {
    sink = 1;
    glsum_mark_begin();
    for (int i = 0; i < n; i++) sink = table[i];
    glsum_mark_end();
    sink = 2;
}
KEEP void outer(void) { sink = 1; glsum_mark_begin(); sink = total(32); glsum_mark_end(); }
KEEP void by_hand(void) { __asm__ volatile("mov r10, r10\n nop\n nop\n nop\n mov r11, r11" ::: "memory"); }
KEEP void empty(void) { glsum_mark_begin(); glsum_mark_end(); }
KEEP void unmet(void) { sink = 3; glsum_mark_begin(); sink = 4; glsum_mark_end(); }
KEEP void opens(void) { sink = 5; glsum_mark_begin(); }
KEEP void closes(void) { sink = 6; glsum_mark_end(); }
KEEP void spin(void) { for (;;) sink++; }
KEEP void poke(void) { sink = *(volatile int *)0xF0000000; }
void (*volatile keep)(void) = unmet;
int main(void) {
    MARKED
    return 0;
}
C
build() { out=$1; shift; link_foreign "$out" -I "$source/targets" "$foreign/start.c" "$folder/marked.c" "$@"; }
place_of() {  # FUNCTION MARK ELF: where the mark stands in it: $address, and as $place
    at=$(arm-none-eabi-objdump -d -M reg-names-raw --no-show-raw-insn --disassemble="$1" "$folder/$3" | tr '\t' ' ' | sed -n "s/^ *\([0-9a-f]*\): *mov $2\$/\1/p")
    begins=$(arm-none-eabi-nm "$folder/$3" | sed -n "s/^\([0-9a-f]*\) . $1\$/\1/p")
    address=$(printf '0x%08x' "0x$at") place=$1+$(printf '0x%x' $((0x$at - 0x$begins)))
}
begin_of() { place_of "$1" 'r10, r10' "$2"; }
end_of() { place_of "$1" 'r11, r11' "$2"; }
of() { sed -n "/\"function\": \"$1\"/,/\"hot\"/p" "$folder/marks.json" | tr -d ' \n'; }

build marked.elf -DMARKED='filter(3); filter(8); outer(); by_hand(); empty(); opens(); sink = 7; closes(); filter(8);'
expect 0 "by_hand+0x0 on " time --elf "$folder/marked.elf" --marks --json "$folder/marks.json" --calls "$folder/calls.csv"
[ "$(grep -c '"function":' "$folder/marks.json")" = 5 ] || fail "expected the five stretches that were met: $(grep '"function"' "$folder/marks.json")"
# Three calls of one that is not a function; two marks and nothing between them; a mark's own instruction does not count.
begin_of filter marked.elf
of "$place" | grep -q '"calls":3' || fail "$place: expected three"
[ "$(grep -c "^\"$place\"" "$folder/calls.csv")" = 3 ] || fail "$place: expected a row a call"
of by_hand+0x0 | grep -q '"calls":1,"instructions":{"min":3,"median":3,"max":3}' || fail "by_hand: expected its three instructions: $(of by_hand+0x0)"
of empty+0x0 | grep -q '"instructions":{"min":0,"median":0,"max":0},"model_cycles":{"min":0.0,"median":0.0,"max":0.0,' || fail "empty: expected nothing: $(of empty+0x0)"
# What it closes need not lie in the same function.
begin_of opens marked.elf
of "$place" | grep -q '"calls":1' || fail "$place: expected one that another function ends"
# Callees count: the call's instructions, and what is around it.
begin_of outer marked.elf
expect 0 "total on " time --elf "$folder/marked.elf" --function total --marks --json "$folder/marks.json"
median() { of "$1" | sed 's/.*"model_cycles":{"min":[0-9.]*,"median":\([0-9.]*\).*/\1/'; }
echo "$(median "$place") $(median total)" | awk '{ exit !($1 > $2 && $1 < $2 + 20) }' ||
    fail "$place: expected somewhat more than total's $(median total), found $(median "$place")"
# A function is timed as if nobody had marked anything.
of total >"$folder/beside"
expect 0 "total on " time --elf "$folder/marked.elf" --function total --json "$folder/marks.json"
[ "$(of total)" = "$(cat "$folder/beside")" ] || fail "total: expected the same beside stretches"
expect 0 "by_hand+0x0 on cortex-m4-zerowait" time --elf "$folder/marked.elf" --marks --core cortex-m4-zerowait

# Marks that do not pair: one error, which says where.
wrong() {  # STATUS TEXT ELF OPTION...
    status=$1 text=$2 elf=$3
    shift 3
    expect "$status" "$text" time --elf "$folder/$elf" --marks "$@"
    [ "$(wc -l <"$folder/said")" = 1 ] || fail "$elf: expected one sentence: $(cat "$folder/said")"
}
build open.elf -DMARKED='by_hand(); opens(); sink = 8;'
begin_of opens open.elf
wrong 2 "the stretch that glsum_mark_begin at $address in opens began never met glsum_mark_end before the program ended" open.elf
build end.elf -DMARKED='by_hand(); closes(); opens();'
end_of closes end.elf
wrong 2 "glsum_mark_end at $address in closes ends no stretch" end.elf
build nested.elf -DMARKED='opens(); by_hand(); closes();'
begin_of opens nested.elf
outside=$address
begin_of by_hand nested.elf
wrong 2 "glsum_mark_begin at $address in by_hand stands within the stretch that glsum_mark_begin at $outside in opens began" nested.elf
build twice.elf -DMARKED='opens(); opens(); closes();'
begin_of opens twice.elf
wrong 2 "glsum_mark_begin at $address in opens stands within the stretch that glsum_mark_begin at $address in opens began" twice.elf
build unmet.elf -DMARKED='sink = 9;'
wrong 1 "none of its 6 glsum_mark_begin was executed" unmet.elf
# A program that hangs or faults within one says so, and where.
build hang.elf -DMARKED='opens(); spin(); closes();'
begin_of opens hang.elf
expect 1 "at $address in opens began never met glsum_mark_end; " time --elf "$folder/hang.elf" --marks --timeout 2
grep -q ' in spin$' "$folder/said" || fail "hang.elf: expected to be told that it was in spin: $(cat "$folder/said")"
build fault.elf -DMARKED='opens(); poke(); closes();'
expect 1 "it faulted at 0x" time --elf "$folder/fault.elf" --marks
grep -q 'began never met glsum_mark_end; .* in poke' "$folder/said" || fail "fault.elf: expected to be told that it was in poke: $(cat "$folder/said")"
# None at all, and nothing asked for.
link_foreign app.elf "$foreign/app.S"
wrong 2 "no glsum_mark_begin (mov r10, r10) in its code" app.elf
cp "$folder/marked.elf" "$folder/stripped.elf" && arm-none-eabi-strip "$folder/stripped.elf"
wrong 2 "found one without symbols" stripped.elf
expect 2 "expected --function NAME or --marks" time --elf "$folder/app.elf"
[ "$failures" -eq 0 ]
