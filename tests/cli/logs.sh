#!/bin/sh
# Logs as loggers write them, through the commands that read them: the note that says how a log was read, the options that decide,
# several inputs, and the user's own simulation. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"

"$program" stand --ideal --set noise.deviation=0.003 --set interval_s=0.02 --until-s 8 --duty 0.1 --experiment prbs --bit-s 0.5 \
    --seed 1 --model "$folder/linear.json" --out "$folder/plain.csv" 2>"$folder/said" || { cat "$folder/said"; failures=$((failures + 1)); }

# The same log as a spreadsheet of a country with decimal commas writes it: it reads as the plain one.
grep -v '^#' "$folder/plain.csv" | awk -F, 'NR == 1 {print "\357\273\277t_ms;u;measured"; print "ms;V;rad"; next}
    {line = sprintf("%.6f;%s;%s", 1000 * $1, $2, $3); gsub(/\./, ",", line); printf "%s\r\n", line}' >"$folder/comma.csv"
note="comma.csv: read with a byte order mark, semicolons, decimal commas, a row of units, stamps in milliseconds, 't_ms' as time, \
'u' as input, 'measured' as output"
expect 0 "$note" resample "$folder/comma.csv" --step-s 0.02 --out "$folder/from_comma.csv"
expect 0 "samples at 0.02 s" resample "$folder/plain.csv" --step-s 0.02 --out "$folder/from_plain.csv"
awk -F, 'NR == FNR {line[NR] = $0; next} FNR > 1 {split(line[FNR], other, ","); for (i = 1; i <= 3; ++i)
    if ((d = $i - other[i]) > 1e-6 || d < -1e-6) bad = FNR} END {exit bad || FNR < 300}' "$folder/from_plain.csv" "$folder/from_comma.csv" ||
    { echo "expected the log of decimal commas to be that of points"; failures=$((failures + 1)); }
for command in "diagnose drive --model $folder/linear.json --log" "identify --form fopdt --start tangent --method none --log" \
    "indices --model $folder/linear.json --log" "simulate --model $folder/linear.json --step-s 0.02 --no-compare --input"; do
    expect 0 "comma.csv: read with a byte order mark, semicolons" $command "$folder/comma.csv"
done

# What may be read in two ways, and what decides.
printf 'time_s,input,output\n0,0,1,0,0,5\n0,1,1,0,0,6\n0,2,1,0,0,9\n' >"$folder/two_ways.csv"
expect 2 "two_ways.csv:2: expected 3 fields, as the header has, found 6: with decimal commas it may be '0,0 1,0 0,5'" \
    resample "$folder/two_ways.csv" --step-s 0.1
expect 0 "3 samples at 0.1 s" resample "$folder/two_ways.csv" --step-s 0.1 --decimal comma
expect 2 "--separator: " resample "$folder/two_ways.csv" --step-s 0.1 --separator pipe
printf '0 1 3\n10 1 4\n20 2 5\n' >"$folder/bare.csv"
expect 0 "read with blanks between fields, no header, column 1 as time" resample "$folder/bare.csv" --step-s 5
expect 0 "3 samples at 0.01 s" resample "$folder/bare.csv" --step-s 0.01 --time-unit ms --input-column 2 --output-column 3
expect 2 "expected a column angl for the output, found 'time_s,duty,angle_rad'; nearest: 'angle_rad'" \
    resample "$folder/plain.csv" --step-s 1 --output-column angl

# Stamps of reception, in bursts of four.
awk 'BEGIN {print "time_s,input,output"; for (k = 0; k < 80; ++k) printf "%.2f,1,%d\n", int(k / 4) * 0.04, k}' >"$folder/bursts.csv"
expect 0 "60 repeated stamps, from line 3: stamped in bursts, as received" resample "$folder/bursts.csv" --step-s 0.01

# Several inputs and the user's own simulation.
grep -v '^#' "$folder/plain.csv" | awk -F, 'NR == 1 {print $0 ",load,own"; next} {print $0 "," int(NR / 50) % 2 "," $3 + 0.01}' >"$folder/wide.csv"
expect 0 "verdict: " diagnose drive --model "$folder/linear.json" --log "$folder/wide.csv" --input-column duty --input-column load \
    --simulated own
expect 2 "expected a column lod for the input" diagnose drive --model "$folder/linear.json" --log "$folder/wide.csv" --input-column duty \
    --input-column lod
expect 2 "expected a column owm for the simulation, found 'time_s,duty,angle_rad,load,own'; nearest: 'own'" diagnose drive \
    --model "$folder/linear.json" --log "$folder/wide.csv" --simulated owm
[ "$failures" -eq 0 ]
