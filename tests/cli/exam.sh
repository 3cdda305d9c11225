#!/bin/sh
# An exam as a person takes and scores it: answers, refusals, hashes that fit and hashes that do not. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"

mkdir -p "$folder/logs"
make() { # NAME EXPERIMENT SEED
    "$program" stand --ideal --set noise.deviation=0.003 --set interval_s=0.02 --until-s 20 --duty 0.1 --low-duty 0.02 --bit-s 0.5 \
        --set input_dead_zone.width=0.02 --experiment "$2" --seed "$3" --out "$folder/logs/$1.csv" 2>"$folder/said" || { cat "$folder/said"; failures=$((failures + 1)); }
}
make train staircase 1
make other prbs 2
"$program" stand --ideal --set interval_s=0.02 --experiment step --until-s 1 --model "$folder/logs/linear.json" --out "$folder/any.csv"
cat >"$folder/manifest.json" <<'EOF'
{"schema": "glsum-exam-1", "questions": [
  {"name": "dead_zone", "train": ["train.csv"], "validate": ["other.csv"], "base": "linear.json", "domain": "mechanical", "units": {"angle_rad": "rad"}},
  {"name": "absent", "train": ["absent.csv"], "base": "fit:fopdt"}]}
EOF
cat >"$folder/truth.json" <<'EOF'
{"schema": "glsum-exam-truth-1", "questions": [
  {"name": "dead_zone", "known": "listed", "causes": [{"any_of": ["input_dead_zone"]}], "attainable_gap": 0.015},
  {"name": "absent", "known": "nothing"}]}
EOF
expect 2 "expected --out DIR" diagnose --exam "$folder/manifest.json"
expect 2 "cannot read" diagnose --exam "$folder/none.json" --out "$folder/answers"
expect 0 "dead_zone  attributed" diagnose --jobs 2 --exam "$folder/manifest.json" --data "$folder/logs" --out "$folder/answers"
grep -q "^absent  refused: .*absent.csv" "$folder/said" || { cat "$folder/said"; failures=$((failures + 1)); }
(cd "$folder/answers" && sha256sum --quiet -c answers.sha256) || { echo "expected the hash of each answer"; failures=$((failures + 1)); }
grep -q '"domain": "mechanical"' "$folder/answers/dead_zone/verdict.json" || { echo "expected the question beside its verdict"; failures=$((failures + 1)); }
expect 2 "expected a folder that is new or empty" diagnose --exam "$folder/manifest.json" --data "$folder/logs" --out "$folder/answers"
# Without --data the logs lie beside the manifest.
cp "$folder/manifest.json" "$folder/logs"
expect 0 "dead_zone  attributed" diagnose --exam "$folder/logs/manifest.json" --out "$folder/again"
cmp "$folder/answers/dead_zone/verdict.json" "$folder/again/dead_zone/verdict.json" >/dev/null || grep -q "$folder" "$folder/again/dead_zone/verdict.json" ||
    { echo "expected the same answer again"; failures=$((failures + 1)); }

expect 0 "1.00 points of 2" score --exam "$folder/answers" --truth "$folder/truth.json" --json "$folder/score.json"
grep -q '"glsum-exam-score-1"' "$folder/score.json" || failures=$((failures + 1))
expect 0 "of the attainable closed" score --exam "$folder/answers" --truth "$folder/truth.json"
expect 2 "one of them" score
expect 2 "one of them" score "$folder/answers" --exam "$folder/answers"
expect 2 "cannot read" score --exam "$folder/answers" --truth "$folder/none.json"
expect 2 "expected --truth FILE" score --exam "$folder/answers"
sed '/absent/d; s/0.015},/0.015}]}/' "$folder/truth.json" >"$folder/less.json"
expect 2 "expected what is known of absent, found nothing" score --exam "$folder/answers" --truth "$folder/less.json"
sed 's/"absent"/"another"/' "$folder/truth.json" >"$folder/else.json"
expect 2 "expected an answer to another, found none" score --exam "$folder/answers" --truth "$folder/else.json"
echo "another reason" >"$folder/answers/absent/refused.txt"
expect 2 "absent/refused.txt: expected the sha256" score --exam "$folder/answers" --truth "$folder/truth.json"
(cd "$folder/answers" && sha256sum absent/refused.txt dead_zone/verdict.json >answers.sha256)
expect 0 "refused: another reason" score --exam "$folder/answers" --truth "$folder/truth.json"
(cd "$folder/answers" && sha256sum absent/refused.txt ../truth.json >answers.sha256)
expect 2 "expected NAME/verdict.json or NAME/refused.txt, found ../truth.json" score --exam "$folder/answers" --truth "$folder/truth.json"
[ "$failures" -eq 0 ]
