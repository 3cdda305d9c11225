#!/bin/sh
# choose: what it says and exits with, that it agrees with a plain loop, and which measurements of a file it takes.
# Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
m7="--order 0.5 --step-s 0.001 --target m7 --samples 60"
expect 0 "Example:" choose --help
expect 2 "--order" choose --step-s 0.001 --max-error 0.1 --target m7
expect 2 "--max-error" choose --order 0.5 --step-s 0.001 --target m7
expect 2 "found 3" choose --order 3 --step-s 0.001 --max-error 0.1 --target m7
expect 2 "--target: expected host or m7, found gpu" choose --order 0.5 --step-s 0.001 --max-error 0.1 --target gpu
expect 2 "expected both or none" choose $m7 --max-error 0.1 --clock-hz 216e6
expect 2 "needs more than two samples a period" choose --order 0.5 --step-s 0.02 --max-error 0.1 --target m7 --signal sine50
expect 2 "only with --target m7" choose --order 0.5 --step-s 0.001 --max-error 0.1 --target host --max-instructions 9
expect 3 "--max-instructions" choose $m7 --max-error 0.1 --max-cycles 100000
expect 2 "no-such-file" choose $m7 --max-error 0.1 --results no-such-file.json
if GLSUM_QEMU=no-such-emulator "$program" choose $m7 --max-error 0.1 >"$folder/said" 2>&1; then
    echo "choose without an emulator: expected status 3"; failures=$((failures + 1))
fi
expect 0 "at least" choose $m7 --max-error 0.1 --clock-hz 216e6 --rate-hz 1000 --json "$folder/choice.json"
grep -q '"schema": "glsum-choice-1"' "$folder/choice.json" || { echo "expected the choice's schema"; failures=$((failures + 1)); }
grep -q '"share_at_least"' "$folder/choice.json" || { echo "expected the share as a bound"; failures=$((failures + 1)); }
expect 1 "nearest miss" choose $m7 --max-error 0.1 --max-bytes 20
expect 1 "--max-instructions" choose $m7 --max-error 0.1 --max-instructions 10
# Modelled cycles of a file, at its lengths; the upper end of the band holds against the limit.
sum=$(sha256sum "$(dirname "$(dirname "$(dirname "$(dirname "$program")")")")/build/mps2-an500/targets/measure.elf" 2>/dev/null | cut -c 1-64)
if [ -n "$sum" ]; then
    cat >"$folder/model.json" <<JSON
{"context": {"elf_sha256": "$sum"}, "benchmarks": [
{"name": "gl/ring_plain_f32/order:0.5/taps:50/m7:made", "model_cycles_per_sample": 200, "model_cycles_low": 190, "model_cycles_high": 230, "state_bytes": 212, "coefficient_bytes": 196},
{"name": "gl/ring_plain_q31/order:0.5/taps:55/m7:made", "model_cycles_per_sample": 210, "model_cycles_low": 205, "model_cycles_high": 215, "state_bytes": 220, "coefficient_bytes": 200}]}
JSON
    expect 0 "ring_plain_f32 with 50 taps" choose $m7 --max-error 0.1 --core made --results "$folder/model.json"
    expect 0 "ring_plain_q31 with 55 taps" choose $m7 --max-error 0.1 --core made --results "$folder/model.json" --max-cycles 220
    expect 3 "core other" choose $m7 --max-error 0.1 --core other --results "$folder/model.json" --max-cycles 220
fi
expect 0 "40 of 40 random budgets: the same choice" choose --order 0.5 --step-s 0.001 --target m7 --samples 40 --check-against-brute-force 40 --seed 3
[ "$failures" -eq 0 ]
