#!/bin/sh
# The main job in small: what it writes, that it repeats, and that nothing a run meets harms the last good result.
# Argument: the glsum program.
set -u
glsum=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() { echo "$*"; failures=$((failures + 1)); }
# bench NAME OPTION...
bench() {
    name=$1
    shift
    "$glsum" bench --quick --orders 0.5,-0.5 --signals step,noise --benchmark_min_time=0.001 "$@" \
        --out "$folder/$name.json" >"$folder/$name.txt" 2>"$folder/$name.err"
}

bench first --taps 50,120 --table all || fail "first run: $(tail -n 3 "$folder/first.err")"
bench second --taps 50,full --kernels 'ring_*_f32,ring_*_q31,modes_*,null,peer_std_f32' || fail "second run failed: $(tail -n 3 "$folder/second.err")"
for file in first.json first-times.json first.csv first-tidy.csv first.svg first.png; do
    [ -s "$folder/$file" ] || fail "expected the file $file"
done
# What dashboards draw: every row of it has a time, and there are rows of the host and of the modelled core.
grep -q '"real_time": 0.0,' "$folder/first.json" || fail "expected rows without a time in the whole file"
grep -q '"real_time": 0.0,' "$folder/first-times.json" && fail "expected rows with a time alone in first-times.json"
for target in host m7:stm32f746-itcm; do
    grep -q "\"name\": \"gl/.*/$target\"" "$folder/first-times.json" || fail "expected times of $target"
done
# Windows are marked by their lengths, however long the designs beside them are.
for length in 50 120; do
    grep -q ">$length *<" "$folder/first.svg" || fail "expected the mark $length in the picture"
done
grep -q '"json_schema_version"\|"library_build_type"' "$folder/first.json" || fail "expected Google Benchmark's context"
for field in glsum_version commit compiler flags contraction cpu cycle_counter core_file qemu_version elf_sha256 target_count_order placement n_samples seed; do
    grep -q "\"$field\"" "$folder/first.json" || fail "expected the context field $field"
done
for row in 'gl/mirror_simd_f32/order:0.5/taps:50/accuracy/signal:step' 'gl/ring_horner_f32/order:-0.5/taps:full/m7:count' \
    'gl/null/order:0.5/taps:50/host' 'gl/peer_std_f32/order:0.5/taps:full/host' 'gl/shift_plain_f64/order:0.5/taps:50/m7:count' \
    'gl/ring_plain_q31/order:0.5/taps:full/m7:stm32f746-itcm' 'gl/modes_plain_f32/order:0.5/taps:2+9/host' \
    'gl/modes_compensated_f32/order:-0.5/taps:1+12/accuracy/signal:noise' 'gl/modes_plain_q31/order:-0.5/taps:1+12/m7:stm32f746-itcm'; do
    grep -q "\"name\": \"$row\"" "$folder/first.json" "$folder/second.json" || fail "expected the row $row"
done
grep -q 'gl/mirror_simd_f32/.*/m7' "$folder/first.json" && fail "a host kernel has a target row"
grep -q '"label": "instructions only; counted at order 0.5; double precision in software' "$folder/first.json" ||
    fail "expected the order of the count in the label"
grep -qi 'nan\|infinity' "$folder/first.csv" && fail "a counter is not a number"
grep -q 'double in software' "$folder/first.txt" || fail "expected the mark of double precision in software"

# Without more said, the answer: a screen, no wider than 120 columns. All of it, where that fits a screen.
bench screen --taps 50,120,200,600,full --kernels "*_plain_f32,*_multi_f32" --targets m7 || fail "third run: $(tail -n 3 "$folder/screen.err")"
[ "$(wc -l <"$folder/screen.txt")" -le 60 ] && [ "$(wc -L <"$folder/screen.txt")" -le 120 ] ||
    fail "expected at most 60 lines of 120 columns, found $(wc -lL <"$folder/screen.txt")"
grep -q "^order 0.5: the cheapest within each decade of error, by cycles of a Cortex-M7, modelled for stm32f746-itcm$" "$folder/screen.txt" &&
    grep -q "^  Within 1e-4: modes[a-z]*_plain_f32 .* cycles; the cheapest window, " "$folder/screen.txt" || fail "expected the cheapest of each decade: $(head -n 9 "$folder/screen.txt")"
bench few --taps 50 --kernels ring_plain_f32 --targets m7 && grep -q "error max  rounding" "$folder/few.txt" || fail "expected the whole table of few rows"
bench none --table most; [ $? -eq 2 ] || fail "expected --table to be refused"
grep -q '"error_occurred": true' "$folder/first.json" && fail "a row is wrong"

# Same seed, same numbers, whatever is measured beside: everything but the host's times.
for run in first second; do
    grep 'gl/\(ring_[a-z]*_\(f32\|q31\)\|modes_[^/]*\)/[^/]*/taps:\(50\|[0-9]*+[0-9]*\)/' "$folder/$run.csv" | grep -v '/host,' >"$folder/$run.fixed"
done
[ "$(wc -l <"$folder/second.fixed")" -gt 100 ] || fail "expected rows of the second run"
cmp -s "$folder/first.fixed" "$folder/second.fixed" || fail "two runs differ: $(diff "$folder/first.fixed" "$folder/second.fixed" | head -n 4)"

# Killed in the middle: the last good result is whole.
sum=$(cksum <"$folder/first.json")
bench first --taps 50,120 &
child=$!
sleep 0.5
kill -9 "$child" 2>/dev/null
pkill -9 -P "$child" 2>/dev/null
wait "$child" 2>/dev/null
[ "$sum" = "$(cksum <"$folder/first.json")" ] || fail "a killed run changed the last result"

# Google Benchmark's own comparison reads the files, where it is installed (Debian packages libbenchmark-tools, python3-scipy).
compare=/usr/share/benchmark/compare.py
if [ -e "$compare" ] && /usr/bin/python3 -c 'import scipy.stats' 2>/dev/null; then
    /usr/bin/python3 "$compare" benchmarks "$folder/first.json" "$folder/second.json" >"$folder/compared" 2>&1 ||
        fail "compare.py: $(tail -n 3 "$folder/compared")"
fi
[ "$failures" -eq 0 ]
