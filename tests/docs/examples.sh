#!/bin/sh
# The examples of the families' pages: what each prints is what its page shows, in C++ by this build's library, and in C99 by a header
# that the page's command makes. Arguments: the launcher on this build's programs, the source folder, the folder of the compiled examples.
set -u
program=$1
examples=$2/docs/site/examples
compiled=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0
compare() { cmp -s "$1" said || { echo "$1: expected"; cat "$1"; echo "found"; cat said; failures=$((failures + 1)); }; }
for source in "$examples"/*.cpp; do
    family=$(basename "$source" .cpp)
    "$compiled/$family" >said || { echo "$family: exit status $?"; failures=$((failures + 1)); }
    compare "$examples/$family.txt"
    # The options stand in the page's own list.
    options=$(sed -n "s/^    \"$family\": \"\(--kernel.*\)\",\$/\1/p" "$2/docs/site/pages/families.py")
    [ -n "$options" ] || { echo "pages/families.py: expected the options of $family, found none"; failures=$((failures + 1)); continue; }
    # shellcheck disable=SC2086
    "$program" generate --order 0.5 --step-s 0.001 $options --out half_derivative.h >log 2>&1 || { cat log; failures=$((failures + 1)); continue; }
    cc -O2 -Wall -Wextra -Werror -I. "$examples/half_derivative.c" -o example -lm && ./example >said || { echo "$family: in C: exit status $?"; failures=$((failures + 1)); }
    compare "$examples/$family-c.txt"
done
[ "$failures" -eq 0 ]
