#!/bin/sh
# The virtual stand as a person uses it: logs, models from them, our own Tables 2 and 3. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"

expect 0 "series-4.csv: 501 samples" stand --seed 1 --out "$folder/stand"
for form in fopdt sopdt; do
    expect 0 "sum of squares" identify "$folder/stand/series-1.csv" --form $form --out "$folder/$form.json"
done
expect 0 "largest error over the record" simulate --model "$folder/sopdt.json" --input "$folder/stand/series-2.csv" --out "$folder/simulated.csv"
expect 0 "simulated.csv" indices "$folder/stand/series-2.csv" --simulated "$folder/simulated.csv"
expect 0 "NRMSE fit" indices "$folder/stand/series-2.csv" --model "$folder/fopdt.json" --model "$folder/sopdt.json"
# The disturbed series is further from the model of the first than the repeatable ones are.
fit_of() { "$program" indices "$folder/stand/series-$1.csv" --model "$folder/sopdt.json" --json | sed -n 's/.*"nrmse_fit": \([-0-9.]*\),*/\1/p'; }
[ "$(echo "$(fit_of 2) > $(fit_of 4) + 0.02" | awk '{print ($1 > $3 + $5)}')" = 1 ] ||
    { echo "series 2 $(fit_of 2) and 4 $(fit_of 4): expected a better fit of the undisturbed one"; failures=$((failures + 1)); }

# Without effects, the model that it writes is the stand.
expect 0 "" stand --ideal --experiment prbs --until-s 20 --model "$folder/linear.json" --out "$folder/linear.csv"
expect 0 "100.00%" indices "$folder/linear.csv" --model "$folder/linear.json"
expect 0 "[coulomb_friction]" stand --show
"$program" stand --show --set backlash.gap=0.01 --out "$folder/own.toml"
expect 0 "gap = 0.01" stand --stand "$folder/own.toml" --show
expect 0 "true_angle_rad" stand --experiment release --truth
"$program" stand --experiment chirp --seed 3 >"$folder/a.csv"
"$program" stand --experiment chirp --seed 3 >"$folder/b.csv"
cmp "$folder/a.csv" "$folder/b.csv" || failures=$((failures + 1))
"$program" stand --experiment staircase --duty 0.28 --until-s 80 --out "$folder/stairs.csv" 2>"$folder/said"
expect 0 "the output bends away from it by up to" identify "$folder/stairs.csv" --static --out "$folder/characteristic.csv"
expect 2 "expected a hold of the input of at least 100 s" identify "$folder/stairs.csv" --static --hold-s 100
expect 2 "expected one of the effects gain_error" stand --without wear --experiment step
expect 2 "backlash.gap: expected 0 to 10, found -1" stand --set backlash.gap=-1 --experiment step
expect 2 "--set: expected NAME=NUMBER, found backlash.gap" stand --set backlash.gap --experiment step
expect 2 "found square" stand --experiment square
expect 2 "expected --out FOLDER" stand
expect 2 "cannot read" stand --stand "$folder/none.toml" --experiment step
printf '[backlash]\nwidth = 1\n' >"$folder/wrong.toml"
expect 2 "wrong.toml:2: backlash: expected gap, found width" stand --stand "$folder/wrong.toml" --experiment step
[ "$failures" -eq 0 ]
