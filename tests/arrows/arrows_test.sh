#!/bin/sh
# arrows.sh on small projects of its own: what it must find, and what it must leave alone. Argument: the project's folder.
set -u
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

# begin: a project of three rooms, one above the other, without a fault.
begin() {
    rm -rf "$folder/p" && mkdir -p "$folder/p/tests/arrows" "$folder/p/base" "$folder/p/low" "$folder/p/high/part" "$folder/p/made"
    printf '# rooms\nbase:\nlow:\nhigh: low\nmade: high\n' >"$folder/p/tests/arrows/may_include.txt"
    printf '#pragma once\n' >"$folder/p/base/a.hpp"
    printf '#include "base/a.hpp"\n#include "base/made_here.hpp"\n' >"$folder/p/low/b.hpp"
    printf '// the text\n' >"$folder/p/base/made_here.hpp.in"
    printf '#include <vector>\n#include "low/b.hpp"\n' >"$folder/p/high/part/c.cpp"
    printf '#include "high/part/d.hpp"\n' >"$folder/p/made/e.cpp"
    printf '\n' >"$folder/p/high/part/d.hpp"
    : >"$folder/p/links"
}
# expect STATUS TEXT
expect() {
    sh "$source/tests/arrows/arrows.sh" "$folder/p" "$folder/p/links" >"$folder/said" 2>&1
    found=$?
    if [ "$found" -ne "$1" ] || ! grep -qF -e "$2" "$folder/said"; then
        echo "expected status $1 and \"$2\"; found status $found and:"
        cat "$folder/said"
        failures=$((failures + 1))
    fi
}
table="$folder/p/tests/arrows/may_include.txt"

begin
expect 0 "every arrow is in the table"
# Upward, from a header and from a line that is not the first.
echo '  #  include "high/part/d.hpp"' >>"$folder/p/low/b.hpp"
expect 1 "low/b.hpp:3: low may not include high (high/part/d.hpp)"
echo 'low/b.hpp -> high/part/d.hpp: it is on its way' >>"$table"
expect 0 "every arrow is in the table"
# The exception covers this arrow alone, and has a reason.
echo '#include "high/part/d.hpp"' >"$folder/p/low/f.cpp"
expect 1 "low/f.cpp:1: low may not include high"
rm "$folder/p/low/f.cpp"
sed -i 's/: it is on its way//' "$table"
expect 1 "may_include.txt:6: expected FILE -> INCLUDED: REASON"
begin
echo 'low/b.hpp -> high/part/d.hpp: it is on its way' >>"$table"
expect 1 "may_include.txt:6: no longer needed: low/b.hpp high/part/d.hpp"
# By the same table as a file beside it, and over two rooms: an arrow is no way.
begin
echo '#include "low/b.hpp"' >>"$folder/p/made/e.cpp"
expect 1 "made/e.cpp:2: made may not include low"
echo '#include "e.hpp"' >"$folder/p/made/e.cpp" && : >"$folder/p/made/e.hpp"
expect 0 "every arrow is in the table"
echo '#include "low/none.hpp"' >"$folder/p/made/e.cpp"
expect 1 "made/e.cpp:1: includes low/none.hpp, which is no file of the project"
# Rooms: new ones, empty ones, ones that are named and not there; a room within a room; a file as a room.
begin
mkdir "$folder/p/newer" && : >"$folder/p/newer/g.cpp"
expect 1 "newer/g.cpp: its room is not in"
begin
echo 'gone: low' >>"$table"
expect 1 "may_include.txt:6: no file belongs to gone"
begin
sed -i 's/^high: low/high: low lower/' "$table"
expect 1 "may_include.txt:4: lower is no room"
begin
echo 'high/part:' >>"$table"
expect 1 "high/part/c.cpp:2: high/part may not include low"
begin
echo 'high/part/c: low' >>"$table" && sed -i 's/^high: low/high:/' "$table"
expect 0 "every arrow is in the table"
begin
sed -i 's/^high: low/high: */' "$table"
expect 0 "every arrow is in the table"
begin
echo 'low: high' >>"$table"
expect 1 "may_include.txt:6: low is there twice"
# What is linked, and what is handed on without being shown.
begin
printf 'h high/part l low private\nl low b base public\n' >"$folder/p/links"
expect 0 "every arrow is in the table"
echo 'l low h high/part private' >"$folder/p/links"
expect 1 "l links h: low may not use high"
echo 'h high/part l low public' >"$folder/p/links"
expect 1 "h hands on l: no header of high includes low"
echo '#include "low/b.hpp"' >"$folder/p/high/part/d.hpp"
expect 0 "every arrow is in the table"
# A part that is a room of its own stands for the room's library.
begin
sed -i 's|^high: low|high: low/b|' "$table" && echo 'low/b:' >>"$table" && echo '// another' >"$folder/p/low/k.hpp"
echo '#include "low/b.hpp"' >"$folder/p/high/part/d.hpp"
echo 'h high/part l low public' >"$folder/p/links"
expect 0 "every arrow is in the table"
sed -i 's|^made: high|made:|' "$table" && : >"$folder/p/made/e.cpp"
echo 'm made l low private' >"$folder/p/links"
expect 1 "m links l: made may not use low"
echo 'x elsewhere l low private' >"$folder/p/links"
expect 1 "x links l: expected rooms"
[ "$failures" -eq 0 ]
