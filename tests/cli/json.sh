#!/bin/sh
# --json means one thing in every command: with a FILE it goes there beside the text, and without one, or with -, it alone goes to
# standard output. Arguments: the launcher on this build's programs, the source folder.
set -u
program=$1
source=$2
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }

# Every page that has it says so, and none has it as a bare flag.
grep -l -e '^  --json' "$source"/cli/help/glsum-* | while read -r page; do
    tr -s ' \n' ' ' <"$page" | grep -q -e '--json \[FILE\].*alone on standard output without FILE or with -' || echo "${page##*/}: another --json"
done | grep . && failures=$((failures + 1))

# is_json FILE
is_json() {
    printf 'file(READ "%s" text)\nstring(JSON type TYPE "${text}")\n' "$1" >"$folder/read.cmake"
    cmake -P "$folder/read.cmake" >/dev/null 2>&1
}
# same WORD...: the three ways of one command.
same() {
    "$program" "$@" --json "$folder/file.json" >"$folder/text" 2>/dev/null
    [ -s "$folder/text" ] || fail "$*: --json FILE: expected the text on standard output"
    is_json "$folder/file.json" || fail "$*: --json FILE: no JSON there"
    case $(head -c 1 "$folder/text") in '{' | '[') fail "$*: --json FILE: expected text and no JSON on standard output" ;; esac
    "$program" "$@" --json - >"$folder/dash" 2>/dev/null
    cmp -s "$folder/dash" "$folder/file.json" || fail "$*: --json -: expected what FILE has"
    "$program" "$@" --json >"$folder/bare" 2>/dev/null
    cmp -s "$folder/bare" "$folder/file.json" || fail "$*: --json: expected what FILE has"
    if "$program" "$@" --json >/dev/full 2>"$folder/said"; then fail "$*: expected a status for a full disk"; fi
    grep -q "standard output: cannot be written: No space left" "$folder/said" || fail "$*: of a full disk found $(cat "$folder/said")"
}
models=$source/drive/models
"$program" simulate --model "$models/fopdt.json" --input staircase --until-s 20 --out "$folder/log.csv" >/dev/null 2>&1 || fail "simulate"
same simulate --model "$models/fopdt.json" --until-s 2
same simulate --model "$models/fopdt.json" --at 1,2
same stability --model "$models/niopdt.json"
same indices "$folder/log.csv" --model "$models/sopdt.json"
"$program" bench --quick --kernels ring_plain_f32 --orders 0.5 --taps 20,50 --signals step --targets host --out "$folder/a.json" >/dev/null 2>&1 || fail "bench"
same compare "$folder/a.json" "$folder/a.json"
same trend "$folder/a.json" "$folder/a.json"
same gate --baseline "$folder/a.json" --current "$folder/a.json"
"$program" diagnose drive --model "$models/fopdt.json" --log "$folder/log.csv" --json - >"$folder/verdict" 2>/dev/null
is_json "$folder/verdict" || fail "diagnose drive --json -: expected JSON alone"

# Where words may stand alone, one behind --json that does not end so is no FILE.
expect 0 '"model"' indices --json "$folder/log.csv" --model "$models/sopdt.json"
"$program" indices "$folder/log.csv" --model "$models/sopdt.json" --json --out "$folder/out.json" >"$folder/text" 2>&1
is_json "$folder/out.json" && [ ! -s "$folder/text" ] || fail "indices --json --out FILE: expected JSON there and nothing printed"
[ "$failures" -eq 0 ]
