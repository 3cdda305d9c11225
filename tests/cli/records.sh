#!/bin/sh
# bench records as a person uses it, on short records. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"

expect 2 "--records: expected 1000 to 10000000 samples, found 999" bench --records 999
expect 2 "found 10000001" bench --records 1000,10000001
expect 2 "found 1e5" bench --records 1e5
expect 2 "found -5" bench --records=-5
expect 2 "--records" bench --records
expect 2 "--drive" bench --records 1000 --drive
expect 2 "--taps" bench --records 1000 --taps 600
expect 2 "--targets" bench records 1000 --targets host
expect 2 "--orders: expected a number in (-2, 2], found 3" bench --records 1000 --orders 3
expect 2 "found square" bench --records 1000 --signals square
expect 2 "cannot write" bench --records 1000 --out /proc/glsum/out.json

expect 0 "20 rows in" bench records 4000,1000 --orders 0.5,1.9909 --signals step,noise --repetitions 3 --out "$folder/records.json"
for how in whole blocks window600 peer_fftw peer_fftwmeasured; do
    for place in order:0.5/samples:1000 order:1.9909/samples:4000; do
        grep -qF "\"name\": \"record/${how}_f64/$place/host\"" "$folder/records.json" ||
            { echo "expected a row record/${how}_f64/$place/host; found:"; grep '"name"' "$folder/records.json"; failures=$((failures + 1)); }
    done
done
# Full memory beside a window of 600: what is exact and what is not.
expect 0 "20 rows" report "$folder/records.json" --out "$folder/records.html"
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; if (!at["error_max"] || !at["ns_per_sample"] || !at["times_peer"]) exit 1; next }
    $0 ~ /window600_f64\/order:0.5/ { windows += $at["error_max"] > 1e-4 }
    $0 ~ /whole_f64|blocks_f64|peer/ { full += $at["error_max"] < 1e-13 }
    $0 ~ /peer_fftw_f64/ { peers += $at["times_peer"] == 1 }
    $at["ns_per_sample"] > 0 { timed += 1 }
    END { good = windows == 2 && full == 16 && peers == 4 && timed == 20
          if (!good) printf "%d %d %d %d\n", windows, full, peers, timed
          exit !good }' \
    "$folder/records.csv" || { echo "expected 2 16 4 20: windows that forget, full memories that do not, peers at 1, rows timed"; head -n 3 "$folder/records.csv"; failures=$((failures + 1)); }
[ "$failures" -eq 0 ]
