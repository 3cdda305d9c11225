#!/bin/sh
# docs/results.md: its scripts run on the files of a run, as far as their interpreters are here. Arguments: the launcher on this build's
# programs, the source folder.
set -u
program=$1
source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
"$program" bench --quick --kernels modes_plain_f32,ring_plain_f32 --orders 0.5 --out run.json >said 2>&1 || { cat said; exit 1; }
failures=0
# runs LANGUAGE TEXT COMMAND...: the page's block of that language, in which that text is printed
runs() {
    awk -v language="$1" '$0 == "```" language { on = 1; next } /^```$/ { on = 0 } on' "$source/docs/results.md" >"block.$1"
    [ -s "block.$1" ] || { echo "docs/results.md: no block of $1"; failures=$((failures + 1)); return; }
    text=$2
    shift 2
    if ! "$@" >said 2>&1 || ! grep -qE "$text" said; then
        echo "$*: expected $text, found:"
        head -n 5 said
        failures=$((failures + 1))
    fi
}
ran=0
if command -v jq >/dev/null; then runs sh 'modes_plain_f32/order:0.5/.* [0-9]+$' sh block.sh; ran=1; fi
if /usr/bin/python3 -c 'import pandas' 2>/dev/null; then runs python '^modes_plain_f32 +2\+9 +.* 1[0-9][0-9]\.' /usr/bin/python3 block.python; ran=1; fi
if command -v Rscript >/dev/null; then runs r 'stall_fpu_latency +[0-9]' Rscript block.r; ran=1; fi
[ "$ran" = 1 ] || { echo "no jq, pandas or R here"; exit 77; }
[ "$failures" -eq 0 ]
