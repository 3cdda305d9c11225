#!/bin/sh
# run.sh [SECONDS [TARGET...]]: lets libFuzzer look for inputs that break a parser, SECONDS (default 600) for each fuzz
# target, or for those named. Builds them first (Debian packages clang, libclang-rt-14-dev). What it has learnt stays in
# build/fuzz/corpus, where the next run goes on. Exits 1 when something was found: the input is kept beside the corpus,
# and belongs into seeds/ once the parser is mended.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
cd "$here/../.."
seconds=${1:-600}
[ $# -eq 0 ] || shift
case $seconds in '' | *[!0-9]* | 0*) echo "run.sh: expected a number of seconds, found $seconds" >&2; exit 2 ;; esac
command -v clang++ >/dev/null || { echo "run.sh: clang++: not found (Debian packages clang, libclang-rt-14-dev)" >&2; exit 3; }

mkdir -p build/fuzz
{ cmake --preset fuzz && cmake --build --preset fuzz; } >build/fuzz/build.log 2>&1 ||
    { tail -n 20 build/fuzz/build.log >&2; echo "run.sh: building failed (whole log: build/fuzz/build.log)" >&2; exit 3; }
[ $# -gt 0 ] || set -- $(cd tests/fuzz/seeds && ls)
found=''
for target; do
    [ -x "build/fuzz/tests/fuzz/fuzz_$target" ] || { echo "run.sh: $target: no such target; expected some of: $(cd tests/fuzz/seeds && echo *)" >&2; exit 2; }
    corpus=build/fuzz/corpus/$target
    mkdir -p "$corpus" "build/fuzz/found/$target"
    log=build/fuzz/$target.log
    if "build/fuzz/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -max_len=8192 -timeout=20 -rss_limit_mb=2048 \
        -artifact_prefix="build/fuzz/found/$target/" -print_final_stats=1 "$corpus" "tests/fuzz/seeds/$target" >"$log" 2>&1; then
        printf '%-14s %4d s  %10d inputs, nothing found\n' "$target" "$seconds" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")"
    else
        found="$found $target"
        printf '%-14s %s\n' "$target" "$(grep -m 1 SUMMARY "$log" || tail -n 1 "$log") (log: $log; input: $(ls -t "build/fuzz/found/$target"/* | head -n 1))"
    fi
done
[ -z "$found" ] || { echo "run.sh: findings in:$found"; exit 1; }
