#!/bin/sh
# A sweep measured in shards and merged is the sweep measured at once; what does not belong together is refused, by name.
# Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
bench() {
    out=$1
    shift
    "$program" bench --quick --kernels 'null,*_plain_q15,ring_plain_f??,mirror_simd_f32,peer_std_f32' --orders 0.5,1.9909,-0.5 --taps 20,600 \
        --signals step,sine5,noise --benchmark_min_time=0.001 --out "$out" "$@" >"$folder/bench.txt" 2>&1 ||
        fail "bench $*: $(tail -n 3 "$folder/bench.txt")"
}
# Rows with all their counters, in their order; of host rows the names.
rows() { sed 's|^\([^,]*/host\),.*|\1|' "$1"; }

bench "$folder/whole.json"
[ "$failures" -eq 0 ] || exit 1
rows "$folder/whole.csv" >"$folder/whole.rows"
for aspect in /accuracy/ /amplitude: /m7:count /m7:stm32f746-itcm /host peer_std; do
    grep -q "$aspect" "$folder/whole.rows" || fail "expected rows of $aspect"
done
for count in 1 2 3 7; do
    shards=''
    for index in $(seq "$count"); do
        bench "$folder/$index-$count.json" --shard "$index/$count"
        shards="$folder/$index-$count.json $shards"  # the last first
        grep -q '/host"' "$folder/$index-$count.json" && [ "$index" -ne "$count" ] && fail "shard $index/$count times the host"
    done
    expect 0 "rows in" merge $shards --out "$folder/merged.json"
    rows "$folder/merged.csv" | cmp -s - "$folder/whole.rows" ||
        fail "merged of $count: $(rows "$folder/merged.csv" | diff - "$folder/whole.rows" | head -n 4)"
    [ -s "$folder/merged.svg" ] || fail "expected a picture of the merged run"
done
sed -n '/"context"/,/"benchmarks"/p' "$folder/merged.json" >"$folder/context"
for field in shards commit elf_sha256 sweep cycle_counter; do
    grep -q "\"$field\"" "$folder/context" || fail "expected the context field $field after merging"
done
grep -q '"shard"\|mixed_hosts' "$folder/context" && fail "a merged context calls itself a shard, or of mixed hosts"

three="$folder/1-3.json $folder/2-3.json $folder/3-3.json"
for bad in 0/3 4/3 3 1/3/3 a/3 1/ /3 -1/3 1/10001 ''; do
    expect 2 "--shard: expected I/N with 1 <= I <= N" bench --quick --shard "$bad" --out "$folder/bad.json"
done
expect 2 "shards" merge
expect 2 "missing: shard 2/3" merge "$folder/1-3.json" "$folder/3-3.json" --out "$folder/bad.json"
expect 2 "shard 2/3 is there twice: $folder/2-3.json and $folder/2-3.json" merge $three "$folder/2-3.json" --out "$folder/bad.json"
expect 2 "found a result file without context.shard" merge "$folder/whole.json" --out "$folder/bad.json"
expect 2 "found a result file without context.shard" merge "$folder/merged.json" --out "$folder/bad.json"
expect 2 "cannot read" merge "$folder/none.json" --out "$folder/bad.json"
expect 4 "number of shards" merge $three "$folder/1-2.json" --out "$folder/bad.json"
head -c 3000 "$folder/2-3.json" >"$folder/cut.json"
expect 2 "$folder/cut.json:" merge "$folder/1-3.json" "$folder/cut.json" "$folder/3-3.json" --out "$folder/bad.json"
# One field of the second shard's context changed.
changed() {
    sed "s|$1|$2|" "$folder/2-3.json" >"$folder/changed.json"
    cmp -s "$folder/2-3.json" "$folder/changed.json" && fail "$1: nothing to change"
}
for field in glsum_version commit dirty compiler flags contraction simd qemu_version elf_sha256 target_count_order placement; do
    changed "\"$field\": \"[^\"]*\"" "\"$field\": \"other\""
    expect 4 "$field differs" merge "$folder/1-3.json" "$folder/changed.json" "$folder/3-3.json" --out "$folder/bad.json"
    grep -qF "\"other\" in $folder/changed.json" "$folder/said" || fail "$field: expected the file that differs"
done
changed '"n_samples": 1000' '"n_samples": 999'
expect 4 "n_samples differs" merge "$folder/1-3.json" "$folder/changed.json" "$folder/3-3.json" --out "$folder/bad.json"
changed '"seed": 2020' '"seed": 2021'
expect 4 "seed differs" merge "$folder/1-3.json" "$folder/changed.json" "$folder/3-3.json" --out "$folder/bad.json"
changed '1.9909,' '1.5,'
expect 4 "sweep.orders differs" merge "$folder/1-3.json" "$folder/changed.json" "$folder/3-3.json" --out "$folder/bad.json"
changed '"cpu": "[^"]*"' '"cpu": "other"'
expect 4 "cpu differs" merge "$folder/1-3.json" "$folder/changed.json" "$folder/3-3.json" --out "$folder/bad.json"
[ ! -e "$folder/bad.json" ] || fail "a refused merge left a file"
expect 0 "rows in" merge --allow-mixed-hosts "$folder/1-3.json" "$folder/changed.json" "$folder/3-3.json" --out "$folder/mixed.json"
grep -q '"mixed_hosts": "true"' "$folder/mixed.json" || fail "expected the context field mixed_hosts"
[ "$failures" -eq 0 ]
