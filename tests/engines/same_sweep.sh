# For tests of engines: a small sweep, and whether $folder/merged.json is what one run of it gives.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
set -f  # globs of kernels are for the program
fail() { echo "$*"; failures=$((failures + 1)); }
options="--quick --kernels null,*_plain_q15,ring_plain_f* --orders 0.5,-0.5 --taps 20,full --signals step,noise --benchmark_min_time=0.001"

# Rows with all their counters, in their order; of host rows the names. Argument: the glsum program.
compare_with_whole() {
    "$1" bench $options --out "$folder/whole.json" >"$folder/whole.txt" 2>&1 || fail "bench: $(tail -n 3 "$folder/whole.txt")"
    for run in whole merged; do sed 's|^\([^,]*/host\),.*|\1|' "$folder/$run.csv" >"$folder/$run.rows"; done
    [ "$(wc -l <"$folder/whole.rows")" -gt 40 ] || fail "expected more than 40 rows, found $(wc -l <"$folder/whole.rows")"
    cmp -s "$folder/whole.rows" "$folder/merged.rows" || fail "merged: $(diff "$folder/whole.rows" "$folder/merged.rows" | head -n 4)"
}
