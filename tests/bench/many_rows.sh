#!/bin/sh
# many_rows.sh KERNELS I/N OUT.json: shard I/N of a made-up sweep of so many kernels, nine orders, twelve lengths and seven signals:
# 864 rows a kernel, as full as those of a real run. 116 kernels make 100 224 rows. For measuring how long readers take.
set -eu
kernels=$1 index=${2%/*} count=${2#*/} out=$3
awk -v kernels="$kernels" -v index_="$index" -v count="$count" '
function row(name, aspect_fields) {
    printf "%s    {\n      \"name\": \"%s\",\n      \"family_index\": 0,\n      \"per_family_instance_index\": 0,\n", separator, name
    printf "      \"run_name\": \"%s\",\n      \"run_type\": \"iteration\",\n      \"repetitions\": 1,\n      \"repetition_index\": 0,\n", name
    printf "      \"threads\": 1,\n      \"iterations\": 1000,\n      \"real_time\": 0.0,\n      \"cpu_time\": 0.0,\n      \"time_unit\": \"ns\",\n"
    printf "%s,\n      \"coefficient_bytes\": 2396,\n      \"state_bytes\": 4812\n    }", aspect_fields
    separator = ",\n"
}
BEGIN {
    srand(7)
    orders = split("0.2 0.3 0.5 0.7 0.9 0.98319 1.5 1.9909 -0.5", order, " ")
    lengths = split("50 75 100 150 200 300 400 500 600 800 1000 full", taps, " ")
    signals = split("step ramp sine1 sine5 sine50 noise drive", signal, " ")
    # A piece is an order here: its accuracy and its counts.
    for (o = index_; o <= orders; o += count) pieces = pieces (pieces == "" ? "" : ", ") "[" o - 1 ", " kernels * lengths * (signals + 1) "]"
    printf "{\n  \"context\": {\n    \"date\": \"never\", \"host_name\": \"none\", \"cpu\": \"none\", \"commit\": \"made up\",\n"
    printf "    \"shard\": {\"index\": %d, \"count\": %d, \"pieces\": %d, \"rows_of_pieces\": [%s]}\n  },\n  \"benchmarks\": [\n", index_, count, orders, pieces
    for (o = index_; o <= orders; o += count) {
        for (s = 1; s <= signals; ++s) for (k = 1; k <= kernels; ++k) for (l = 1; l <= lengths; ++l) {
            e = rand() * 10 ^ (-2 - 10 * rand())
            row("gl/ring_plain" k "_f32/order:" order[o] "/taps:" taps[l] "/accuracy/signal:" signal[s], sprintf("      \"error_max\": %.17g,\n      \"error_rms\": %.17g,\n      \"rounding_error_max\": %.17g,\n      \"truncation_error_max\": %.17g,\n      \"effective_taps\": 50,\n      \"macs_per_sample\": 50", e, e / 3, e / 5, e * 0.9))
        }
        for (k = 1; k <= kernels; ++k) for (l = 1; l <= lengths; ++l)
            row("gl/ring_plain" k "_f32/order:" order[o] "/taps:" taps[l] "/m7:count", sprintf("      \"label\": \"instructions only; counted at order 0.2\",\n      \"instructions_per_sample\": %.1f,\n      \"loads_per_sample\": 601.0,\n      \"stores_per_sample\": 3.0,\n      \"branches_per_sample\": 77.0,\n      \"worst_instructions\": 3617,\n      \"code_bytes\": 512,\n      \"stack_bytes\": 24", 500 + 5000 * rand()))
    }
    printf "\n  ]\n}\n"
}' >"$out"
