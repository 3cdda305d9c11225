#!/bin/sh
# time: programs of one's own, compiled here for the emulated board, timed to the letter of the answer's form.
# Arguments: the glsum program; the project's folder; the build folder of the emulated board's firmware.
set -u
program=$1 source=$2 firmware=$3
. "$(dirname "$0")/expect.sh"
. "$(dirname "$0")/../foreign/foreign.sh"
fail() { echo "$*"; failures=$((failures + 1)); }

# Functions of every kind of ending.
cat >"$folder/main.c" <<'C'
#define KEEP __attribute__((noinline, noclone))
volatile int sink;
static float a[64], b[64];
KEEP int leaf(int x) { __asm__ volatile("" : "+r"(x)); return x + 1; }
KEEP int caller(int x) { return leaf(x) + leaf(x + 1); }
KEEP int tail(int x) { __asm__ volatile("nop"); return leaf(x * 3); } /* ends in a jump to leaf */
KEEP int fib(int n) { __asm__ volatile("" : "+r"(n)); return n < 2 ? n : fib(n - 1) + fib(n - 2); }
KEEP float dot(const float *x, const float *y, int n) {
    float sum = 0;
    for (int i = 0; i < n; i++) sum += x[i] * y[i];
    return sum;
}
KEEP int uneven(int n) { int s = 0; for (int i = 0; i < n; i++) { s += i; __asm__ volatile("" : "+r"(s)); } return s; }
KEEP double power(double x, int n) { double y = 1; for (int i = 0; i < n; i++) y = y * x + 0.5; return y; } /* no double unit */
static inline __attribute__((always_inline)) int gone(int x) { return x ^ 5; }
KEEP void never(void) { for (;;) sink++; }
KEEP void uncalled(void) { sink = 7; }
void (*volatile keep)(void) = uncalled;
int main(int argc, char **argv) {
    (void)argv;
    for (int i = 0; i < 3; i++) sink = caller(i);
    sink = tail(4);
    sink = fib(6);
    sink = (int)dot(a, b, 64);
    for (int i = 1; i <= 4; i++) sink = uneven(10 * i);
    sink = (int)power(0.75, 40);
    sink = gone(sink);
    for (int i = 0; i < MANY; i++) sink = leaf(i);
#ifdef HANG
    never();
#endif
    return STATUS;
}
C
build() { out=$1; shift; link_foreign "$out" -DMANY=1 -DSTATUS=0 "$foreign/start.c" "$@"; }  # OUT OPTION...
build own.elf "$folder/main.c"

# What a word of the JSON is: field FILE PATH, by the compiler of JSON that every Debian with the build has: none. The form
# is fixed, one value a line, so that lines can be held against it.
has() { grep -qsF -e "$2" "$1" || fail "$(basename "$1"): expected $2; found: $(head -n 40 "$1" 2>&1 | tr -d '\n' | cut -c 1-600)"; }
timed() {  # NAME OPTION...: into $folder/NAME.json
    name=$1
    shift
    expect 0 "$name on " time --elf "$folder/own.elf" --function "$name" --json "$folder/$name.json" "$@"
}

# Callees count; three calls.
timed caller
for field in '"schema": "glsum-time-1"' '"elf_sha256": "'"$(sha256sum "$folder/own.elf" | cut -c 1-64)" '"function": "caller"' \
    '"core": "stm32f746-itcm"' '"code": "itcm"' '"data": "dtcm"' '"calls": 3' '"instructions"' '"min"' '"median"' '"max"' \
    '"model_cycles"' '"low"' '"high"' '"stalls"' '"branch_mispredict"' '"hot"' '"address": "0x' '"symbol": "leaf"' \
    '"disassembly": "' '"cycles"' '"unknown_encodings": []'; do
    has "$folder/caller.json" "$field"
done
# 2 calls of leaf (adds, bx) and what objdump says caller has.
own=$(arm-none-eabi-objdump -d --disassemble=caller "$folder/own.elf" | grep -c '^ *[0-9a-f]*:')
has "$folder/caller.json" "\"median\": $((own + 4)),"
leaf=$(arm-none-eabi-objdump -d --no-show-raw-insn --disassemble=leaf "$folder/own.elf" | sed -n 's/^ *[0-9a-f]*:\t//p' | tr '\t' ' ' | head -n 1)
has "$folder/caller.json" "\"disassembly\": \"$leaf\""

# A tail call ends where control returns to the caller: tail's own instructions and leaf's two.
timed tail
own=$(arm-none-eabi-objdump -d --disassemble=tail "$folder/own.elf" | grep -c '^ *[0-9a-f]*:')
has "$folder/tail.json" "\"median\": $((own + 2)),"
has "$folder/tail.json" '"calls": 1,'

# Recursion: the outer call alone, the inner ones in it, and it says so.
timed fib
has "$folder/fib.json" '"calls": 1,'
grep -q 'calls itself' "$folder/said" || fail "fib: expected to be told of the recursion"

# Calls of unequal length: min, median, max differ.
timed uneven
tr -d ' \n' <"$folder/uneven.json" | grep -qE '"calls":4,"instructions":\{"min":([0-9]+),"median":([0-9]+),"max":([0-9]+)\}' ||
    fail "uneven: expected 4 calls; found $(tr -d ' \n' <"$folder/uneven.json" | cut -c 1-300)"

# Placement: slower memories, more cycles; fetches from flash without a cache wait.
median_of() { tr -d ' \n' <"$1" | sed 's/.*"model_cycles":{"min":[0-9.]*,"median":\([0-9.]*\).*/\1/'; }
timed dot --place code=itcm --place data=dtcm
fast=$(median_of "$folder/dot.json")
timed dot --core stm32f746-flash-nocache
slow=$(median_of "$folder/dot.json")
has "$folder/dot.json" '"code": "flash"'
timed dot --place code=axi --place data=axi
has "$folder/dot.json" '"code": "axi"'
has "$folder/dot.json" '"data": "axi"'
[ "$(printf '%s\n%s\n' "$fast" "$slow" | sort -g | head -n 1)" = "$fast" ] && [ "$fast" != "$slow" ] ||
    fail "dot: expected fewer cycles in ITCM ($fast) than in flash without caches ($slow)"
timed dot --without fpu_latency

# Double precision in software: all cycles within its routines are told apart, and can be taken away.
share_of() { tr -d ' \n' <"$1" | sed 's/.*"double_precision_in_software":\([0-9.]*\).*/\1/'; }
timed dot
[ "$(share_of "$folder/dot.json")" = 0.0 ] || fail "dot: expected nothing in double precision, found $(share_of "$folder/dot.json")"
timed power
whole=$(median_of "$folder/power.json") in_double=$(share_of "$folder/power.json")
timed power --without double_precision_in_software,interrupt_load
grep -q '^interrupt_load  .*beside a call' "$folder/said" || fail "power: expected to be told that interrupts lie beside a call"
rest=$(median_of "$folder/power.json")
[ "$(share_of "$folder/power.json")" = 0.0 ] && echo "$whole $in_double $rest" | awk '{exit !($1 == $2 + $3 && $2 > $1 / 2 && $3 > 0)}' ||
    fail "power: expected the share in double precision and the rest to sum to the whole, found $in_double + $rest of $whole"
# Placed by section and by address: as the whole placed so.
sed 's/\*(\.text\*) \*(\.rodata\*)/*(.text*) } > CODE .rodata : { *(.rodata*)/' "$foreign/map.ld" >"$folder/sections.ld"
cat >"$folder/table.c" <<'C'
static const int table[256] = {1, 2, 3};
volatile int sink;
__attribute__((noinline, noclone)) int look(const int *t) { int s = 0; for (int i = 0; i < 256; i++) s += t[i]; return s; }
int main(void) { sink = look(table); return 0; }
C
arm-none-eabi-gcc $core -O2 -ffreestanding -nostdlib -T "$folder/sections.ld" "$foreign/start.c" "$folder/table.c" \
    -o "$folder/table.elf" 2>"$folder/said" || cat "$folder/said"
look() {  # TEXT OPTION...: the median into $cycles
    text=$1
    shift
    expect 0 "$text" time --elf "$folder/table.elf" --function look --json "$folder/look.json" "$@"
    cycles=$(median_of "$folder/look.json")
}
look "look on" --core stm32f746-flash-nocache
whole=$cycles
look "look on" --core stm32f746-flash-nocache --place code=itcm
in_itcm=$cycles
look "look on" --core stm32f746-flash-nocache --place code=itcm --place .rodata=flash
in_flash=$cycles
has "$folder/look.json" '"place": "flash"'
address=$(arm-none-eabi-objdump -h "$folder/table.elf" | awk '$2 == ".rodata" { print $4 }')
look "look on" --core stm32f746-flash-nocache --place code=itcm --place "0x$address-$(printf %x $((0x$address + 1024)))=flash"
[ "$in_flash" = "$cycles" ] && echo "$in_flash $in_itcm" | awk '{ exit !($1 > 2 * $2) }' ||
    fail "look: expected a table in flash to cost more than in ITCM ($in_itcm), by section ($in_flash) as by address ($cycles)"
expect 2 "no section .nothing; expected one of" time --elf "$folder/table.elf" --function look --place .nothing=dtcm
expect 2 "--place: expected code=" time --elf "$folder/table.elf" --function look --place 0x10=dtcm
expect 2 "--place: expected code=" time --elf "$folder/table.elf" --function look --place 0x20-0x10=dtcm
expect 2 "place: expected itcm" time --elf "$folder/table.elf" --function look --place .rodata=ram

# A core file of one's own, which changes what its base has.
mkdir "$folder/my cores"
printf 'base = "stm32f746-flash-nocache"\n[rows.memory]\nclock_hz = { value = 30000000, mark = "assumed", source = "a test" }\nbus_overhead = { value = 0, mark = "assumed", source = "a test" }\n' \
    >"$folder/my cores/slow.toml"
look "look on slow" --core "$folder/my cores/slow.toml"
has "$folder/look.json" '"core": "slow"'
echo "$whole $cycles" | awk '{ exit !($1 > 1.2 * $2) }' || fail "look: expected fewer cycles than $whole at 30 MHz, found $cycles"
expect 2 "no such core file" time --elf "$folder/table.elf" --function look --core "$folder/none.toml"

expect 0 "m7-ideal" time --elf "$folder/own.elf" --function dot --core m7-ideal

# Wrong use, each with one clear error.
expect 2 "no function nowhere" time --elf "$folder/own.elf" --function nowhere
expect 2 "inlined" time --elf "$folder/own.elf" --function gone
expect 1 "never called" time --elf "$folder/own.elf" --function uncalled
expect 2 "--place" time --elf "$folder/own.elf" --function dot --place stack=dtcm
expect 2 "code" time --elf "$folder/own.elf" --function dot --place code=sram
expect 2 "no such effect" time --elf "$folder/own.elf" --function dot --without magic
expect 2 "no such core" time --elf "$folder/own.elf" --function dot --core no-such-core
expect 2 "$folder/none.elf" time --elf "$folder/none.elf" --function dot
expect 2 "$foreign/start.c" time --elf "$foreign/start.c" --function dot
expect 2 "found" time --elf /bin/true --function main
build status.elf -UMANY -DMANY=1 -USTATUS -DSTATUS=5 "$folder/main.c"
expect 1 "5" time --elf "$folder/status.elf" --function dot

# A function that does not return, in a program that never ends: told within the limit, not waited for.
build hang.elf -DHANG "$folder/main.c"
expect 1 "did not return" time --elf "$folder/hang.elf" --function never --timeout 2

# A program that faults says where, with the function's name: in a load, at an instruction that is none, behind a jump to nowhere.
cat >"$folder/bad.c" <<'C'
#define KEEP __attribute__((noinline, noclone))
volatile int sink;
KEEP int leaf(int x) { __asm__ volatile("" : "+r"(x)); return x + 1; }
KEEP void poke(volatile int *p) { sink = 1; sink = *p; sink = 2; }
KEEP void strange(void) { __asm__ volatile("udf #0"); }
KEEP void jump(void (*to)(void)) { sink = 1; to(); sink = 2; }
KEEP void spin(void) { for (;;) sink++; }
int main(void) { sink = leaf(1); BAD; return 0; }
C
for bad in 'poke((int *)0xF0000000)' 'strange()' 'jump((void (*)(void))0x30000001)'; do
    build bad.elf -DBAD="$bad" "$folder/bad.c"
    at=$(arm-none-eabi-objdump -d "$folder/bad.elf" | sed -n "/<${bad%%(*}>:/,/^\$/p" | grep -E 'ldr.*\[r0|udf|blx' | head -n 1 | sed 's/^ *\([0-9a-f]*\):.*/\1/')
    expect 1 "it faulted at 0x$(printf %08x "0x$at") in ${bad%%(*}" time --elf "$folder/bad.elf" --function leaf
done
build bad.elf -DBAD="spin()" "$folder/bad.c"
expect 1 "was silent for " time --elf "$folder/bad.elf" --function leaf --timeout 2  # longer where others take the processor
grep -q 'for [0-9]* s and was ended; the last instruction that it executed was at 0x[0-9a-f]* in spin$' "$folder/said" || fail "bad.elf: expected to be told that it was in spin: $(cat "$folder/said")"
# Without a handler the core locks up, and the emulator dies of it: a sentence, no dump of registers.
sed 's/(void \*)fault/0/g; s/, (void \*)tick//' "$foreign/start.c" >"$folder/bare.c"
link_foreign bare.elf -DBAD='poke((int *)0xF0000000)' "$folder/bare.c" "$folder/bad.c"
at=$(arm-none-eabi-objdump -d --disassemble=poke "$folder/bare.elf" | sed -n 's/^ *\([0-9a-f]*\):.*ldr.*\[r0.*/\1/p')
locks_up() {  # PROGRAM PLACE
    expect 1 "Lockup: " time --elf "$folder/$1" --function leaf
    grep -q "$2" "$folder/said" || fail "$1: expected $2, found: $(cat "$folder/said")"
    [ "$(wc -l <"$folder/said")" = 1 ] || fail "$1: expected one sentence"
}
locks_up bare.elf "; it faulted at 0x$(printf %08x "0x$at") in poke; the last instruction that it executed was at 0x00000000$"
# The handler faults in its turn.
sed 's/void fault(void) {/& (void)*(volatile int *)0xF0000000;/' "$foreign/start.c" >"$folder/twice.c"
link_foreign twice.elf -DBAD='poke((int *)0xF0000000)' "$folder/twice.c" "$folder/bad.c"
locks_up twice.elf "; it faulted at 0x[0-9a-f]* in poke; the last instruction that it executed was at 0x[0-9a-f]* in fault$"

# Programs for other cores. The M0's code runs on an M7.
other() {  # STATUS TEXT FLAG...
    status=$1 text=$2
    shift 2
    echo 'int leaf(int x) { return x + 1; } void _start(void) { leaf(1); }' >"$folder/other.c"
    arm-none-eabi-gcc "$@" -O1 -ffreestanding -nostdlib -Wl,-Ttext=0 "$folder/other.c" -o "$folder/other.elf" 2>/dev/null || return
    expect "$status" "$text" time --elf "$folder/other.elf" --function leaf
}
other 2 "ARMv8-M mainline" -mcpu=cortex-m33 -mthumb
other 2 "profile A" -mcpu=cortex-a9
sed 's/sum += x\[i\] \* y\[i\]/sum += 2/' "$folder/main.c" >"$folder/m0.c"
arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -O2 -ffreestanding -nostdlib -DMANY=1 -DSTATUS=0 -T "$foreign/map.ld" \
    "$foreign/start.c" "$folder/m0.c" -o "$folder/m0.elf" -lgcc 2>"$folder/said" || cat "$folder/said"
expect 0 "1 calls" time --elf "$folder/m0.elf" --function tail

# Called 100 000 times.
build many.elf -UMANY -DMANY=100000 "$folder/main.c"
expect 0 "100007 calls" time --elf "$folder/many.elf" --function leaf

# Assembly without sizes or attributes of C; a call through a register; a function that interrupts the caller's block.
cat >"$folder/hand.S" <<'S'
    .syntax unified
    .cpu cortex-m7
    .thumb
    .section .vectors, "a"
    .word 0x20010000, start + 1, 0, 0
    .text
    .thumb_func
start:
    ldr r4, =work + 1
    movs r5, #3
1:  blx r4
    subs r5, r5, #1
    bne 1b
    movs r0, #0x20
    ldr r1, =leave
    bkpt 0xab
    .thumb_func
    .global work
    .type work, %function
work:
    movs r0, #10
2:  subs r0, r0, #1
    it ne
    addne r1, r1, #1
    bne 2b
    bx lr
    .align 2
leave:
    .word 0x20026, 0
S
link_foreign hand.elf "$folder/hand.S"
expect 0 "3 calls" time --elf "$folder/hand.elf" --function work --json "$folder/hand.json"
has "$folder/hand.json" '"median": 42,'

# Programs as people have them, on our start-up: newlib's printf and malloc in C, with objects of the soft-float interface, too;
# exceptions, the standard library and static objects in C++.
if [ -e "$firmware/targets/libboard.a" ]; then
    cat >"$folder/app.c" <<'C'
#include <stdio.h>
#include <stdlib.h>
__attribute__((noinline, noclone)) float filter(float x) { static float s; s += 0.125f * (x - s); return s; }
int main(void) {
    float *data = malloc(100 * sizeof *data), sum = 0;
    for (int i = 0; i < 100; i++) sum += data[i] = filter((float)i);
    printf("sum %.3f\n", sum);
    free(data);
    return sum > 4305.9f && sum < 4306.1f ? 0 : 1;
}
C
    cat >"$folder/app.cpp" <<'C'
#include <cstdio>
#include <stdexcept>
#include <vector>
struct Numbers { std::vector<int> all{7, 8}; ~Numbers() { all.clear(); } };
static Numbers numbers;
__attribute__((noinline, noclone)) int checked(int i) { if (i % numbers.all[0] == 0) throw std::runtime_error("seven"); return i; }
int main() {
    int caught = 0;
    for (int i = 0; i < 50; i++) { try { caught += checked(i) < 0; } catch (const std::exception&) { ++caught; } }
    std::printf("caught %d\n", caught);
    return caught == 8 ? 0 : 1;
}
C
    link="-nostartfiles -T $source/targets/mps2-an500/memory.ld -T $source/targets/cortex-m7/sections.ld -Wl,--defsym=firmware_main=main"
    board=$firmware/targets/libboard.a
    linked() {  # PROGRAM COMPILER OPTION...
        elf=$folder/$1 compiler=$2
        shift 2
        "$compiler" -mcpu=cortex-m7 -mthumb -mfpu=fpv5-sp-d16 -O2 "$@" $link -o "$elf" 2>"$folder/said" || { cat "$folder/said"; fail "$elf: not linked"; }
    }
    linked app.elf arm-none-eabi-gcc -mfloat-abi=hard "$folder/app.c" "$board" -lc "$board"
    expect 0 "100 calls" time --elf "$folder/app.elf" --function filter
    linked soft.elf arm-none-eabi-gcc -mfloat-abi=softfp "$folder/app.c" -Wl,--no-warn-mismatch "$board" -lc "$board"
    expect 0 "100 calls" time --elf "$folder/soft.elf" --function filter
    linked cpp.elf arm-none-eabi-g++ -mfloat-abi=hard "$folder/app.cpp" "$board" -lstdc++ -lc "$board"
    expect 0 " 50 calls" time --elf "$folder/cpp.elf" --function checked  # of which eight throw
    cat >"$folder/jump.c" <<'C'
#include <setjmp.h>
jmp_buf place;
__attribute__((noinline, noclone)) int checked(int i) { __asm__ volatile("" ::: "memory"); if (i % 7 == 0) longjmp(place, 1); return i; }
int main(void) {
    static volatile int i, left, sum;
    for (i = 0; i < 50; i++) { if (setjmp(place)) left++; else sum += checked(i); }
    return left == 8 ? 0 : 1;
}
C
    # A group: newlib 4.5's longjmp asks libgcc, which asks for abort, which the board's archive has.
    linked jump.elf arm-none-eabi-gcc -mfloat-abi=hard "$folder/jump.c" -Wl,--start-group "$board" -lc -lgcc -Wl,--end-group
    expect 0 " 50 calls" time --elf "$folder/jump.elf" --function checked
fi

# Linked for a chip's flash: said in a sentence, not by a register dump of the emulator.
sed 's/ORIGIN = 0,/ORIGIN = 0x08000000,/' "$foreign/map.ld" >"$folder/chip.ld"
arm-none-eabi-gcc $core -O2 -ffreestanding -nostdlib -DMANY=1 -DSTATUS=0 -T "$folder/chip.ld" "$foreign/start.c" "$folder/main.c" \
    -lgcc -o "$folder/chip.elf" 2>"$folder/said" || cat "$folder/said"
expect 2 "section .text lies at 0x08000000" time --elf "$folder/chip.elf" --function leaf
[ "$(wc -l <"$folder/said")" = 1 ] || fail "chip.elf: expected one sentence"

# A function that an interrupt calls while the main program runs.
cat >"$folder/interrupt.c" <<'C'
#define KEEP __attribute__((noinline, noclone))
volatile int ticks, sink;
KEEP int handled(int x) { __asm__ volatile("" : "+r"(x)); return x + 3; }
void tick(void) { ticks = handled(ticks) - 2; }
KEEP int wait_for(int n) { while (ticks < n) sink++; return sink; }
int main(void) {
    *(volatile unsigned *)0xE000E014 = 500;
    *(volatile unsigned *)0xE000E018 = 0;
    *(volatile unsigned *)0xE000E010 = 7;
    wait_for(5);
    *(volatile unsigned *)0xE000E010 = 0;
    return 0;
}
C
build interrupt.elf "$folder/interrupt.c"
expect 0 "handled on " time --elf "$folder/interrupt.elf" --function handled --json "$folder/handled.json"
has "$folder/handled.json" '"median": 2,'
# The handler itself: no address says where it returns to. A call each, and no instruction of what it interrupts.
expect 0 "tick on " time --elf "$folder/interrupt.elf" --function tick --function handled --json "$folder/tick.json"
own=$(arm-none-eabi-objdump -d --disassemble=tick "$folder/interrupt.elf" | grep '^ *[0-9a-f]*:' | grep -vc '\.word')
tr -d ' \n' <"$folder/tick.json" >"$folder/flat"
has "$folder/flat" "\"instructions\":{\"min\":$((own + 2)),\"median\":$((own + 2)),\"max\":$((own + 2))}"
grep -o '"calls":[0-9]*' "$folder/flat" | sort -u | grep -c . | grep -qx 1 || fail "tick: expected as many calls as of what it calls"
grep -q '"calls":[0-4],' "$folder/flat" && fail "tick: expected at least five calls"
expect 0 "wait_for on " time --elf "$folder/interrupt.elf" --function wait_for --json "$folder/wait.json"
has "$folder/wait.json" '"calls": 1,'

# Two tasks, which SysTick has PendSV switch, as a small operating system does it: each handler's calls are its own.
cat >"$folder/tasks.c" <<'C'
#define KEEP __attribute__((noinline, noclone))
typedef unsigned u32;
volatile int ticks, sink[2];
volatile u32 now;
u32 stacks[2][256], *volatile sp[2];
extern char stack_top[];
static void leave(void) {
    u32 arguments[2] = {0x20026, 0};
    register u32 r0 __asm__("r0") = 0x20;
    register void *r1 __asm__("r1") = arguments;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}
KEEP int step(int n) { int s = 0; for (int i = 0; i < 200; i++) { s += i ^ n; __asm__ volatile("" : "+r"(s)); } return s; }
KEEP void task(int n) { for (;;) { sink[n] += step(n); if (ticks >= 40) { *(volatile u32 *)0xE000E010 = 0; leave(); } } }
__attribute__((used)) u32 *next(u32 *of) { sp[now] = of; now ^= 1; return sp[now]; }
__attribute__((naked)) void pend(void) {
    __asm__ volatile("mrs r0, psp\n stmdb r0!, {r4-r11}\n push {r3, lr}\n bl next\n pop {r3, lr}\n ldmia r0!, {r4-r11}\n msr psp, r0\n bx lr");
}
void tick(void) { ++ticks; *(volatile u32 *)0xE000ED04 = 1u << 28; }
void begin(void) {
    for (u32 n = 0; n < 2; n++) {
        sp[n] = stacks[n] + 240; /* r4 to r11, r0 to r3, r12, lr, pc, xPSR */
        sp[n][8] = n;
        sp[n][14] = (u32)task;
        sp[n][15] = 1u << 24;
    }
    *(volatile u32 *)0xE000ED20 = 0xFFu << 16 | 0xF0u << 24;
    *(volatile u32 *)0xE000E014 = 20000;
    *(volatile u32 *)0xE000E018 = 0;
    *(volatile u32 *)0xE000E010 = 7;
    __asm__ volatile("msr psp, %0\n mov r0, #2\n msr control, r0\n isb" ::"r"(stacks[0] + 256) : "r0");
    task(0);
}
__attribute__((section(".vectors"), used)) void *const vectors[16] = {
    stack_top, (void *)begin, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, (void *)pend, (void *)tick};
C
arm-none-eabi-gcc -mcpu=cortex-m7 -mthumb -mfloat-abi=soft -O2 -ffreestanding -nostdlib -T "$foreign/map.ld" "$folder/tasks.c" -lgcc \
    -o "$folder/tasks.elf" 2>"$folder/said" || cat "$folder/said"
expect 0 "pend on " time --elf "$folder/tasks.elf" --function pend --function tick --json "$folder/tasks.json"
tr -d ' \n' <"$folder/tasks.json" | sed 's/"function":/\n&/g' >"$folder/flat"
for handler in pend tick; do
    grep "^\"function\":\"$handler\"" "$folder/flat" | grep -q '"calls":[1-9][0-9][0-9]*,' || fail "$handler: expected some tens of calls: $(cat "$folder/flat" | cut -c 1-200)"
done
own=$(arm-none-eabi-objdump -d --disassemble=tick "$folder/tasks.elf" | grep '^ *[0-9a-f]*:' | grep -vc '\.word\|nop')
grep '^"function":"tick"' "$folder/flat" | grep -q "\"min\":$own,\"median\":$own," || fail "tick: expected its $own instructions: $(grep tick "$folder/flat" | cut -c 1-300)"

# The README's example.
if [ -e "$firmware/targets/biquad.elf" ]; then
    expect 0 "1000 calls" time --elf "$firmware/targets/biquad.elf" --function biquad_step
    expect 0 "1 calls" time --elf "$firmware/targets/biquad.elf" --function firmware_main
    expect 0 "1 calls" time --elf "$firmware/targets/biquad.elf" --function 'firmware_main()'
fi

# Several functions in one run: a list, each as if it were timed alone, though one calls the other; and a row a call.
timed caller
timed leaf
expect 0 "leaf on " time --elf "$folder/own.elf" --function caller --function leaf --json "$folder/both.json" --calls "$folder/calls.csv"
for name in caller leaf; do
    sed '1d;$d' "$folder/$name.json" | tr -d ' \n' >"$folder/alone"
    tr -d ' \n' <"$folder/both.json" | grep -qF -e "$(cat "$folder/alone")" || fail "$name: expected the same among others as alone"
done
[ "$(head -c 1 "$folder/both.json")" = "[" ] || fail "expected a list of two functions"
[ "$(grep -c '^"caller",' "$folder/calls.csv")" = 3 ] && [ "$(grep -c '^"leaf",' "$folder/calls.csv")" = 8 ] &&
    head -n 1 "$folder/calls.csv" | grep -q '^function,call,instructions,model_cycles,low,high,single_issue,' ||
    fail "calls.csv: expected 3 calls of caller and 8 of leaf, found: $(cut -d , -f 1 "$folder/calls.csv" | sort | uniq -c | tr '\n' ' ')"
expect 1 "uncalled was never called" time --elf "$folder/own.elf" --function leaf --function uncalled
has "$folder/caller.json" '"name": "chain",'
has "$folder/caller.json" '"reason": "'

# Twice the same, to the last digit.
timed caller
cp "$folder/caller.json" "$folder/once.json"
timed caller
cmp -s "$folder/once.json" "$folder/caller.json" || fail "expected the same JSON twice"
[ "$failures" -eq 0 ]
