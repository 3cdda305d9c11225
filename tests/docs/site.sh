#!/bin/sh
# glsum docs: every page there is, from all that the product lists; a file in the place of its folder is told, and nothing is lost.
# Arguments: the glsum program, the source folder.
set -u
program=$1
source=$2
. "$(dirname "$0")/../cli/expect.sh"
/usr/bin/python3 -c 'import sphinx, furo, myst_parser, breathe' 2>/dev/null && command -v doxygen >/dev/null || {
    echo "no Sphinx, Furo, MyST, Breathe or Doxygen here"
    [ -n "${GLSUM_REQUIRE_BROWSER:-}" ] && exit 1
    exit 77
}
fail() { echo "$*"; failures=$((failures + 1)); }
pages=$folder/pages
"$program" docs --out "$pages" >"$folder/said" 2>&1 || { tail -n 20 "$folder/said"; exit 1; }
for effect in $("$program" list effects | cut -d ' ' -f 1); do
    page=$pages/effects/$effect.html
    [ -s "$page" ] || { fail "expected $page"; continue; }
    for part in 'Equation' 'How it looks in a log' 'What it is confused with' "$effect.svg"; do
        grep -q "$part" "$page" || fail "$page: expected '$part'"
    done
    [ -s "$pages/_images/$effect.svg" ] || fail "expected a picture of $effect"
done
for core in $("$program" list cores | cut -d ' ' -f 1); do
    grep -q 'assumed' "$pages/cores/$core.html" || fail "expected how the figures of $core are known"
done
for example in "$source"/docs/site/examples/*.cpp; do
    family=$(basename "$example" .cpp)
    for part in 'What it costs' 'In C99' 'It prints' 'Its error bound'; do
        grep -q "$part" "$pages/families/$family.html" || fail "$family.html: expected '$part'"
    done
done
for name in $("$program" list kernels | cut -d ' ' -f 1 | grep -v '^null$'); do
    grep -qr ">$name<" "$pages/families" || fail "expected $name on a family's page"
done
grep -q 'design_modes' "$pages/api/glsum-design.html" || fail "expected design_modes among the headers"
grep -qE 'src="https?:|href="https?:[^"]*\.(css|js)"' "$pages/index.html" && fail "expected pages without a network"
echo here >"$folder/file"
expect 2 'expected a folder, found a file' docs --out "$folder/file"
[ "$(cat "$folder/file")" = here ] || fail "expected the file as it was"
[ "$failures" -eq 0 ]
