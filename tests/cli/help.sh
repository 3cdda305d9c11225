#!/bin/sh
# Help and --version: what the launcher says before anything is built is what the programs say. Arguments: the launcher on this build's
# programs, their folder, the source folder.
set -u
program=$1
programs=$2
source=$3
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }

"$source/cli/help.sh" "$programs" "$folder/help" || fail "cli/help.sh"
cp "$source/cli/help/glsum-test" "$folder/help/"
diff -r "$source/cli/help" "$folder/help" || fail "cli/help is not what the programs say; cli/help.sh build/host/cli writes it anew"
! grep -rl "$source/\|$HOME/" "$source/cli/help" || fail "a page names a folder of this machine"

# Every command has its line in the list, its page and its example; each program its line.
sed '/^ *#/d; /^ *$/d; s/ *|.*//' "$source/cli/commands" >"$folder/commands"
while read -r words; do
    expect 0 "  ./glsum $words " --help
    expect 0 "Usage: glsum $words" $words --help
    expect 0 "xample" $words --help
done <"$folder/commands"
ls "$programs" | grep '^glsum-' | while read -r name; do
    tr ' ' '-' <"$folder/commands" | grep -qx "${name#glsum-}" || echo "$name: no such line in cli/commands"
done | grep . && failures=$((failures + 1))
expect 0 "Usage: glsum diagnose drive" diagnose drive --help
expect 0 "Usage: glsum bench records" bench --records --help

# The kernels that --version counts are those that bench knows.
expect 0 "glsum 0." --version
said=$(sed -n 's/^kernels *\([0-9]*\) on the host.*/\1/p' "$folder/said")
"$program" bench --quick --orders=0.5,-0.5 --signals step --targets host --kernels '*' --benchmark_min_time=0.0001 --out "$folder/all.json" >/dev/null 2>&1 || fail "bench"
found=$(sed -n 's|.*"name": "gl/\([a-z0-9_]*\)/.*/host".*|\1|p' "$folder/all.json" | grep -v '^peer_' | sort -u | wc -l)
[ "$said" = "$found" ] || fail "--version counts $said kernels, bench $found"

# A word that is nearly one.
for pair in bnech:bench genrate:generate simualte:simulate gates:gate chose:choose tset:test; do
    expect 2 "nearest is ${pair#*:}," ${pair%:*}
done
expect 2 "no such command" 'b.*'
[ "$failures" -eq 0 ]
