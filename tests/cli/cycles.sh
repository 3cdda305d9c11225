#!/bin/sh
# Modelled cycles from bench to table, report, choose and gate; several cores in one run.
# Arguments: the glsum program; the project's folder.
set -u
program=$1 source=$2
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
bench() {
    out=$1
    shift
    "$program" bench --quick --orders 0.5 --signals step --targets m7 --out "$folder/$out.json" "$@" >"$folder/$out.txt" 2>&1
}
if ! bench one --kernels 'null,ring_plain_q31,shift_plain_f32,ring_horner_f64' --taps 20,50; then
    tail -n 3 "$folder/one.txt"
    [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ] && exit 1
    exit 77
fi
# Without --core: what is counted, and one core.
for row in gl/ring_plain_q31/order:0.5/taps:20/m7:count gl/ring_plain_q31/order:0.5/taps:20/m7:stm32f746-itcm; do
    grep -q "\"name\": \"$row\"" "$folder/one.json" || fail "expected the row $row"
done
grep -qE '"core_file": "stm32f746-itcm sha256:[0-9a-f]{64}"' "$folder/one.json" || fail "expected the core file with its hash"
grep -q 'modelled for stm32f746-itcm' "$folder/one.txt" || fail "expected the core's name over the table"
# One counter of one row, of the CSV.
counter() {
    awk -F, -v row="$2" -v counter="$3" 'NR == 1 {for (i = 1; i <= NF; i++) if ($i == counter) column = i}
        $1 == row {print $column}' "$folder/$1.csv"
}
q31=gl/ring_plain_q31/order:0.5/taps:50/m7:stm32f746-itcm
for name in model_cycles_per_sample model_cycles_low model_cycles_high first_model_cycles worst_model_cycles latency_model_cycles stall_single_issue \
    stall_load_use stall_branch_mispredict instructions_per_sample loads_per_sample code_bytes; do
    [ -n "$(counter one $q31 $name)" ] || fail "expected the counter $name"
done
[ -z "$(counter one gl/ring_plain_q31/order:0.5/taps:50/m7:count model_cycles_per_sample)" ] || fail "m7:count has cycles"
# 216 MHz: the time is the cycles'.
awk -v t="$(counter one $q31 real_time)" -v c="$(counter one $q31 model_cycles_per_sample)" \
    'BEGIN {exit !(t * 0.216 - c < 1e-6 && c - t * 0.216 < 1e-6 && c > 50)}' || fail "expected the time of the cycles at 216 MHz"

# Several cores, one emulation: each as if it were alone.
bench three --kernels 'null,ring_plain_q31,shift_plain_f32,ring_horner_f64' --taps 20,50 --core stm32f746-flash,stm32f746-itcm,m7-ideal ||
    fail "three cores: $(tail -n 2 "$folder/three.txt")"
for name in model_cycles_per_sample model_cycles_low model_cycles_high first_model_cycles worst_model_cycles stall_load_use; do
    [ "$(counter one $q31 $name)" = "$(counter three $q31 $name)" ] || fail "$name changes with the cores beside it"
done
grep -q 'm7:count' "$folder/three.json" && fail "--core names what is wanted, and count was not"
grep -q 'm7:m7-ideal' "$folder/three.json" || fail "expected rows of every core"
bench count --kernels ring_plain_q31 --taps 50 --core count || fail "count alone"
grep -q '"core_file": "none"' "$folder/count.json" || fail "expected no core file with --core count"
expect 2 "no such core" bench --quick --core no-such-core --out "$folder/bad.json"

# The gate: the same run passes; beside another core too; one cycle in a hundred more does not, in any of the counters.
gate() { "$program" gate --baseline "$folder/$1.json" --current "$folder/$2.json" >"$folder/said" 2>&1; }
gate one one || fail "the same run: $(tail -n 3 "$folder/said")"
for name in model_cycles_per_sample first_model_cycles worst_model_cycles; do
    awk -v counter="\"$name\":" '$1 == counter && !done {sub(/,$/, "", $2); printf "%s %.17g,\n", $1, $2 * 1.01 + ($2 == 0); done = 1; next} {print}' \
        "$folder/one.json" >"$folder/slower.json"
    gate one slower
    [ $? -eq 1 ] && grep -q "model_cycles: .*$name" "$folder/said" || fail "$name 1 % up: expected status 1; found $(head -n 5 "$folder/said")"
done
sed 's/sha256:[0-9a-f]*/sha256:0123/' "$folder/one.json" >"$folder/other.json"
gate one other
[ $? -eq 4 ] && grep -q 'core_file' "$folder/said" || fail "another core file: expected status 4; found $(head -n 5 "$folder/said")"
grep -q 'to go on: .*--update-baseline --reason TEXT' "$folder/said" || fail "another core file: expected a way on"
# A core more beside it is no other condition.
bench more --kernels 'null,ring_plain_q31,shift_plain_f32,ring_horner_f64' --taps 20,50 --core count,m7-ideal,stm32f746-itcm ||
    fail "more: $(tail -n 2 "$folder/more.txt")"
gate one more || fail "a core more: $(tail -n 3 "$folder/said")"

# choose models what bench models, at the lengths that it finds; the band's upper end holds against the limit.
choose() { expect "$@" --order 0.5 --step-s 0.001 --target m7 --quick --signal step --core stm32f746-itcm --fresh; }
choose 0 "model cycles" choose --max-error 0.05 --json "$folder/choose.json"
of_kernel() { # of_kernel KERNEL FIELD: in the list of all kernels
    awk -v kernel="\"$1\"," -v field="\"$2\":" '/"kernels": \[/ {list = 1} list && $1 == "\"kernel\":" {on = $2 == kernel}
        list && on && $1 == field {sub(/,$/, "", $2); print $2; exit}' "$folder/choose.json"
}
for kernel in ring_plain_q31 shift_plain_f32; do
    taps=$(of_kernel $kernel taps)
    bench at --kernels "$kernel" --taps "$taps"
    for name in model_cycles_per_sample model_cycles_high; do
        here=$(of_kernel $kernel $name) there=$(counter at gl/$kernel/order:0.5/taps:$taps/m7:stm32f746-itcm $name)
        awk -v a="$here" -v b="$there" 'BEGIN {exit !(a > 50 && a - b < 1e-6 && b - a < 1e-6)}' ||
            fail "$kernel with $taps taps: choose has $name $here, bench $there"
    done
done
choose 1 "--max-cycles" choose --max-error 0.5 --max-cycles 10
[ "$failures" -eq 0 ]
