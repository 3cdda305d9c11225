#!/bin/sh
# Blind cases as a person makes and scores them: hashes that fit and hashes that do not. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"

set_of="$folder/set"
expect 0 "sha256 of the sealed truth: " stand --blind 8 --seed 5 --out "$set_of" --jobs 2
hash=$(sed -n 's/^sha256 of the sealed truth: //p' "$folder/said")
head -n 1 "$folder/said" | grep -q '^sha256' || [ "$(grep -c '^sha256' "$folder/said")" = 1 ] || failures=$((failures + 1))
(cd "$set_of" && sha256sum --quiet -c truth.sha256) || { echo "sha256sum: expected the hash of the sealed truth"; failures=$((failures + 1)); }
[ "$(ls "$set_of" | tr '\n' ' ')" = "001 002 003 004 005 006 007 008 truth.sealed.json truth.sha256 " ] || { ls "$set_of"; failures=$((failures + 1)); }
[ "$(ls "$set_of/003" | tr '\n' ' ')" = "model.json train.csv validate.csv " ] || { ls "$set_of/003"; failures=$((failures + 1)); }
# Nothing but the sealed file tells an effect.
if grep -rlE 'effect|backlash|gain_error|friction|sensor_' "$set_of"/0*; then echo "expected no effect's name in a case"; failures=$((failures + 1)); fi
expect 2 "expected a folder that is new or empty" stand --blind 8 --seed 5 --out "$set_of"
expect 2 "expected --out FOLDER" stand --blind 8
expect 0 "8 cases, seed 5" stand --blind 8 --seed 5 --out "$folder/again"
diff -r "$set_of" "$folder/again" || { echo "expected the same cases of the same seed"; failures=$((failures + 1)); }
expect 0 "stable" stability --model "$set_of/001/model.json"

expect 2 "cannot read" score "$set_of"
answer() { printf '{"schema":"glsum-gap-1","verdict":"%s","effects":[],"ranking":[],"gap":{"base":0.1,"after":0.1,"noise_floor":0.1}}\n' "$1"; }
for case in 001 002 003 004 005 006 007 008; do answer no_gap >"$set_of/$case/verdict.json"; done
(cd "$set_of" && sha256sum 0*/verdict.json >verdicts.sha256)
expect 0 "false alarms                       0/2" score "$set_of" --no-oracle
expect 0 "top-1, all cases                   2/8" score "$set_of" --no-oracle --truth-sha256 "$hash" --json "$folder/score.json"
grep -q '"glsum-blind-score-1"' "$folder/score.json" || failures=$((failures + 1))
expect 1 "goals are not reached" score "$set_of" --no-oracle --goals
expect 2 "as --truth-sha256 says" score "$set_of" --truth-sha256 "$(printf %064d 0)"
# A verdict that was changed after it was hashed, one that is not hashed, one of no case, one that is no verdict.
answer unknown >"$set_of/003/verdict.json"
expect 2 "003/verdict.json: expected the sha256" score "$set_of"
answer no_gap >"$set_of/003/verdict.json"
expect 0 "top-1" score "$set_of" --no-oracle
cp "$set_of/verdicts.sha256" "$folder/all"
grep -v 004 "$folder/all" >"$set_of/verdicts.sha256"
expect 2 "expected a line for 004/verdict.json" score "$set_of"
{ cat "$folder/all"; sed -n 's/001/009/p' "$folder/all"; } >"$set_of/verdicts.sha256"
expect 2 "expected cases of the sealed truth, found 009/verdict.json" score "$set_of"
{ cat "$folder/all"; head -n 1 "$folder/all"; } >"$set_of/verdicts.sha256"
expect 2 "001/verdict.json is there twice" score "$set_of"
echo "no hash" >"$set_of/verdicts.sha256"
expect 2 "verdicts.sha256:1: expected a hash of 64 digits" score "$set_of"
answer perhaps >"$set_of/003/verdict.json"
(cd "$set_of" && sha256sum 0*/verdict.json >verdicts.sha256)
expect 2 "found perhaps" score "$set_of"
answer no_gap >"$set_of/003/verdict.json"
(cd "$set_of" && sha256sum 0*/verdict.json >verdicts.sha256)
# A truth that was changed after its hash was printed.
sed -i 's/"class": "none"/"class": "unlisted"/' "$set_of/truth.sealed.json"
expect 2 "truth.sealed.json: expected the sha256" score "$set_of"
(cd "$set_of" && sha256sum truth.sealed.json >truth.sha256)
expect 2 "as --truth-sha256 says" score "$set_of" --truth-sha256 "$hash"

# Without a model: facts instead, three domains, points instead of an oracle.
open="$folder/open"
expect 2 "expected --blind N beside it" stand --no-model --out "$open"
expect 0 "12 cases, seed 3" stand --blind 12 --no-model --seed 3 --out "$open" --jobs 2
expect 0 "sha256 of the sealed truth: " stand --blind 12 --no-model --seed 3 --out "$folder/open-again"
diff -r "$open" "$folder/open-again" || { echo "expected the same cases of the same seed"; failures=$((failures + 1)); }
(cd "$open" && sha256sum --quiet -c truth.sha256) || failures=$((failures + 1))
for case in "$open"/0*; do
    for file in case.json train validate; do
        ls "$case" | grep -q "^$file" || { echo "$case: expected $file"; failures=$((failures + 1)); }
    done
done
[ "$(cat "$open"/0*/case.json | grep -o '"domain": "[a-z]*"' | sort | uniq -c | tr -s ' \n' ' ')" = ' 4 "domain": "hydraulic" 4 "domain": "mechanical" 4 "domain": "thermal" ' ] ||
    { cat "$open"/0*/case.json; failures=$((failures + 1)); }
if find "$open" -name 'model*' | grep .; then echo "expected no model"; failures=$((failures + 1)); fi
if grep -rlE 'effect|class|_error|friction|sensor_|input_|order|curve|taken|unlisted' "$open"/0*; then echo "expected nothing of the truth in a case"; failures=$((failures + 1)); fi
for case in 001 002 003 004 005 006 007 008 009 010 011 012; do answer no_gap >"$open/$case/verdict.json"; done
(cd "$open" && sha256sum 0*/verdict.json >verdicts.sha256)
expect 0 "nothing to find or taken up: no_gap (>= 95 %)  100.0 %    4 of 4" score "$open" --json "$folder/open.json" --plot "$folder/calibration"
expect 1 "score: 2 goals are not reached" score "$open" --goals
grep -q '"glsum-open-score-1"' "$folder/open.json" || failures=$((failures + 1))
grep -q "None of 0 answers has a confidence of 0.9 or more" "$folder/calibration.svg" && [ -s "$folder/calibration.png" ] || failures=$((failures + 1))
# A batch knows such a case by its facts, and says what is wrong with them.
mkdir -p "$folder/one/001"
cp "$open"/001/train*.csv "$open"/001/validate*.csv "$folder/one/001"
echo '{"schema": "glsum-case-1", "domain": "acoustic"}' >"$folder/one/001/case.json"
expect 2 "case.json: expected one of the domains mechanical, thermal, hydraulic, electric, found acoustic" diagnose --batch "$folder/one"
[ "$failures" -eq 0 ]
