#!/bin/sh
# bench equal-cost as a person uses it, on short records. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
expect 2 "--equal-cost: expected 4 to 600 multiplications, found 3" bench --equal-cost 3
expect 2 "found 601" bench --equal-cost 16,601
expect 2 "found 16x" bench --equal-cost 16x
expect 2 "--taps" bench --equal-cost 16 --taps 16
expect 2 "--records" bench --equal-cost 16 --records 1000
expect 2 "--repetitions" bench equal-cost 16 --repetitions 3
expect 2 "--signals" bench --equal-cost 16 --signals sine7x
expect 0 "Oustaloup's filter" bench --equal-cost 24,8,8 --quick --orders 0.5 --signals step,noise --out "$folder/e.json"
for made in e.json e.svg e.png; do
    [ -s "$folder/$made" ] || { echo "expected $made"; failures=$((failures + 1)); }
done
# Eight ways at two costs on two signals, Oustaloup once more for the one that has a derivative, and the full memory.
rows=$(grep -c '"way"' "$folder/e.json")
[ "$rows" -eq 36 ] || { echo "expected 36 rows, found $rows"; failures=$((failures + 1)); }
expect 0 "36 rows" report "$folder/e.json" --out "$folder/e.html"
[ "$failures" -eq 0 ]
