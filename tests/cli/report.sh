#!/bin/sh
# glsum report as a person uses it: what it writes, and what it says of files that are none. Argument: the glsum program, and
# the program that makes result files.
set -u
program=$1
make_results=$2
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }

"$make_results" 4000 "$folder/a.json"
expect 0 "Example:" report --help
expect 0 "a.html" report "$folder/a.json"
for file in a.html a.csv a-tidy.csv a.svg a.png a-curves.csv a-cost.svg a-cost.png a-fronts.svg a-fronts.png; do
    [ -s "$folder/$file" ] || fail "expected the file $file"
done
expect 0 "least cost at an error, before" report "$folder/a.json"
[ "$(wc -l <"$folder/a.csv")" -eq 4001 ] || fail "expected a line a row in a.csv"
grep -q '^<svg' "$folder/a.svg" || grep -q '<svg' "$folder/a.svg" || fail "expected SVG in a.svg"
# No address outside the page: only the names of XML's own namespaces look like one.
grep -o 'https\{0,1\}://[^"'"'"' )]*' "$folder/a.html" | grep -vE '^http://www\.w3\.org/|^https://d3js\.org$' | head -n 3 >"$folder/addresses"
[ ! -s "$folder/addresses" ] || fail "the page holds addresses: $(cat "$folder/addresses")"
grep -qE '<(script|link|img)[^>]*(src|href)="[^d#]' "$folder/a.html" && fail "the page loads something"

cp "$folder/a.json" "$folder/b.json"
expect 0 "and 4000 of $folder/b.json" report "$folder/a.json" "$folder/b.json" --out "$folder/both.html"
[ "$(cat "$folder/both-difference.csv")" = "name,counter,a,b,ratio,note" ] || fail "a file differs from itself"
before=$(cksum <"$folder/both.html")
expect 2 "none.json: cannot read" report "$folder/none.json" --out "$folder/both.html"
head -c 100000 "$folder/a.json" >"$folder/cut.json"
expect 2 "the file ends in the middle" report "$folder/a.json" "$folder/cut.json" --out "$folder/both.html"
echo '{"context": {}, "benchmarks": [{"name": "gl/a_b_c/order:0.5/taps:50/host", "real_time": NaN}]}' >"$folder/nan.json"
expect 2 "expected a finite number, found NaN" report "$folder/nan.json" --out "$folder/both.html"
[ "$before" = "$(cksum <"$folder/both.html")" ] || fail "a refused file changed the last page"
expect 2 "would be overwritten" report "$folder/a.json" --out "$folder/a.json"
expect 2 "cannot write" report "$folder/a.json" --out /proc/glsum/page.html
expect 2 "" report "$folder/a.json" "$folder/a.json" "$folder/a.json"
echo '{"context": {}, "benchmarks": []}' >"$folder/empty.json"
expect 0 "0 rows of" report "$folder/empty.json"
printf '#!/bin/sh\nshift\nPATH=/nowhere exec "%s-report" "$@"\n' "$program" >"$folder/without"
chmod +x "$folder/without"
program=$folder/without expect 3 "gnuplot" report "$folder/a.json" --out "$folder/unplotted.html"
[ "$failures" -eq 0 ]
