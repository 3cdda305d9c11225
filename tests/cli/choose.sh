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
expect 0 "choice     " choose --order 0 --step-s 0.001 --max-error 0.1 --target host --samples 40
# A longer record takes longer, and is no reason to refuse.
expect 0 "the worst of step over 20000 samples" choose --order 0.5 --step-s 0.001 --max-error 0.05 --target m7 --signal step --samples 20000 --fresh
grep -q 'choice     \(modes_plain\|cascade_df2t\)_f32' "$folder/said" || { echo "expected modes over 20000 samples"; failures=$((failures + 1)); }
expect 2 "--samples" choose --order 0.5 --step-s 0.001 --max-error 0.05 --target m7 --samples 1
expect 2 "--max-error: expected a number above 0, found 0" choose --order 0.5 --step-s 0.001 --max-error 0 --target m7
expect 2 "--rate-hz: expected 1 / --step-s, 1000, found 500" choose --order 0.5 --step-s 0.001 --max-error 0.1 --target m7 --clock-hz 216e6 --rate-hz 500
expect 2 "--target: expected host, m7 or m4, found gpu" choose --order 0.5 --step-s 0.001 --max-error 0.1 --target gpu
expect 2 "expected both or none" choose $m7 --max-error 0.1 --clock-hz 216e6
expect 2 "needs more than two samples a period" choose --order 0.5 --step-s 0.02 --max-error 0.1 --target m7 --signal sine50
expect 2 "only with --target m7" choose --order 0.5 --step-s 0.001 --max-error 0.1 --target host --max-instructions 9
expect 2 "no such core" choose $m7 --max-error 0.1 --core nosuch
expect 2 "with --core use --max-cycles" choose $m7 --max-error 0.1 --core m7-ideal --max-instructions 9
expect 2 "only instructions are counted" choose $m7 --max-error 0.1 --max-cycles 9 --max-instructions 9
expect 2 "no-such-file" choose $m7 --max-error 0.1 --results no-such-file.json
if GLSUM_QEMU=no-such-emulator "$program" choose $m7 --max-error 0.1 >"$folder/said" 2>&1; then
    echo "choose without an emulator: expected status 3"; failures=$((failures + 1))
fi
expect 0 "at least" choose $m7 --max-error 0.1 --clock-hz 216e6 --rate-hz 1000 --max-instructions 100000 --json "$folder/choice.json"
grep -q '"schema": "glsum-choice-1"' "$folder/choice.json" || { echo "expected the choice's schema"; failures=$((failures + 1)); }
grep -q '"share_at_least"' "$folder/choice.json" || { echo "expected the share as a bound"; failures=$((failures + 1)); }
# Cycles are modelled where no file has them, of the core that is asked for.
expect 0 "the model's upper end takes" choose $m7 --max-error 0.1 --clock-hz 216e6 --rate-hz 1000 --max-cycles 100000
expect 0 "modelled for stm32f746-flash" choose $m7 --max-error 0.1 --core stm32f746-flash --json "$folder/flash.json"
expect 1 "nearest miss" choose $m7 --max-error 0.1 --max-bytes 20
expect 1 "--max-instructions" choose $m7 --max-error 0.1 --max-instructions 10
expect 1 "--max-cycles" choose $m7 --max-error 0.1 --max-cycles 10
# Modelled cycles of a file of this firmware and core are taken; the upper end of the band holds against the limit.
"$program" choose $m7 --max-error 0.1 --json "$folder/choice.json" >"$folder/choice.txt" 2>/dev/null
field() { sed -n "s/^ *\"$1\": \"\(.*\)\",*\$/\1/p" "$2" | head -n 1; }
taps=$(sed -n 's/^ *ring_plain_q31  *\([0-9]*\) .*/\1/p' "$folder/choice.txt")
made() { # made CORE_FILE
    cat >"$folder/model.json" <<JSON
{"context": {"elf_sha256": "$(field elf_sha256 "$folder/choice.json")", "core_file": "$1"}, "benchmarks": [
{"name": "gl/ring_plain_q31/order:0.5/taps:$taps/m7:stm32f746-itcm", "model_cycles_per_sample": 2, "model_cycles_low": 1, "model_cycles_high": 230, "state_bytes": 212, "coefficient_bytes": 196}]}
JSON
}
made "m7-ideal sha256:0, $(field core_file "$folder/choice.json")"
expect 0 "choice     ring_plain_q31 with $taps taps" choose $m7 --max-error 0.1 --results "$folder/model.json" --max-cycles 230
expect 0 "choice     cascadedelta" choose $m7 --max-error 0.1 --results "$folder/model.json" --max-cycles 229
made "$(field core_file "$folder/flash.json")"
expect 0 "is not among its cores" choose $m7 --max-error 0.1 --results "$folder/model.json"
expect 0 "choice     cascadedelta" choose $m7 --max-error 0.1 --results "$folder/model.json"
expect 0 "40 of 40 random budgets: the same choice" choose --order 0.5 --step-s 0.001 --target m7 --samples 40 --check-against-brute-force 40 --seed 3
expect 0 "40 of 40 random budgets: the same choice" choose --order 0.5 --step-s 0.001 --target m7 --samples 40 --max-instructions 1 --check-against-brute-force 40 --seed 4
[ "$failures" -eq 0 ]
