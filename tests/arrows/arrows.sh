#!/bin/sh
# arrows.sh ROOT [LINKS]: reads every #include "..." of the product below ROOT against tests/arrows/may_include.txt there, and what the
# libraries link against the same. LINKS: lines "LIBRARY FOLDER LIBRARY FOLDER public|private", written by CMake.
# Exit 1 with a line for each arrow that the table does not have, each file whose room it does not know, each room without a file, each
# exception without an arrow, and each library that hands on what none of its headers includes.
set -eu
root=${1:?arrows.sh: expected the project folder}
links=${2:-/dev/null}
table=$root/tests/arrows/may_include.txt
[ -f "$table" ] || { echo "arrows.sh: $table: expected the table of who may include whom" >&2; exit 2; }
links=$(realpath "$links")
cd "$root"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

find . \( -path ./build -o -path ./tests -o -path ./results -o -path './.*' \) -prune -o -type f \
    \( -name '*.cpp' -o -name '*.hpp' -o -name '*.h' -o -name '*.in' -o -name '*.def' -o -name '*.S' \) -print | sed 's|^\./||' | LC_ALL=C sort >"$work/files"
while read -r file; do
    grep -Hn '^ *# *include "[^{"]*"' "$file" || true
done <"$work/files" >"$work/includes"

awk -v table=tests/arrows/may_include.txt '
    function complain(text) { print text; bad = 1 }
    # The longest room that holds the path; "" if none does.
    function room_of(path,    room, longest, behind) {
        longest = ""
        for (room in may) {
            behind = substr(path, length(room) + 1, 1)
            if (index(path, room) == 1 && (behind == "" || behind == "/" || behind == ".") && length(room) > length(longest)) longest = room
        }
        return longest
    }
    # A library of a room is linked where a part of that room may be included.
    function allows_link(from, to) { return allows(from, to) || index(" " may[from], " " to "/") > 0 }
    function allows(from, to) { return from == to || to == "base" || may[from] ~ /(^| )\*( |$)/ || index(" " may[from] " ", " " to " ") > 0 }
    # Whether a header of a room includes another or a part of it.
    function shows(from, to,    arrow) {
        for (arrow in shown) if (arrow == from " " to || index(arrow, from " " to "/") == 1) return 1
        return 0
    }
    FILENAME ~ /may_include.txt$/ {
        sub(/\r$/, "")
        if ($0 ~ /^ *(#|$)/) next
        if ($2 == "->") {
            key = $1 " " $3; sub(/:$/, "", key); reason = $0
            if (!sub(/^[^ ]+ +-> +[^ ]+: +/, "", reason)) complain(table ":" FNR ": expected FILE -> INCLUDED: REASON, found " $0)
            except[key] = FNR
            next
        }
        if ($1 !~ /:$/) { complain(table ":" FNR ": expected ROOM: ROOM..., found " $0); next }
        room = $1; sub(/:$/, "", room)
        if (room in may) complain(table ":" FNR ": " room " is there twice")
        uses = $0; sub(/^[^:]*: */, "", uses); gsub(/ +/, " ", uses)
        may[room] = uses; line[room] = FNR
        next
    }
    FILENAME ~ /files$/ {
        file[$0] = 1
        room = room_of($0)
        if (room == "") complain($0 ": its room is not in " table)
        else used[room] = 1
        next
    }
    FILENAME ~ /includes$/ {
        split($0, part, ":")
        from = part[1]; number = part[2]
        name = $0; sub(/^[^"]*"/, "", name); sub(/".*/, "", name)
        folder = from; sub(/\/[^\/]*$/, "", folder)
        to = ""
        # As the compilers look: beside the file, then where the libraries let them; what is generated has its text in NAME.in.
        count = split(folder "/" name "|" name "|kernels/" name "|targets/" name "|" name ".in", at, "|")
        for (i = 1; i <= count && to == ""; ++i) if (at[i] in file) to = at[i]
        if (to == "") { complain(from ":" number ": includes " name ", which is no file of the project"); next }
        a = room_of(from); b = room_of(to)
        if (a == "" || b == "") next
        if (from ~ /\.(hpp|h)$/) shown[a " " b] = 1
        if (allows(a, b)) next
        if ((from " " to) in except) { needed[from " " to] = 1; next }
        complain(from ":" number ": " a " may not include " b " (" name ")")
        next
    }
    {
        a = room_of($2); b = room_of($4)
        if (a == "" || b == "") complain($1 " links " $3 ": expected rooms of " table ", found " $2 " and " $4)
        else if (!allows_link(a, b)) complain($1 " links " $3 ": " a " may not use " b)
        else if ($5 == "public" && a != b && b != "base" && !shows(a, b)) complain($1 " hands on " $3 ": no header of " a " includes " b)
    }
    END {
        for (room in may) {
            if (!(room in used)) complain(table ":" line[room] ": no file belongs to " room)
            n = split(may[room], uses_of, " ")
            for (i = 1; i <= n; ++i) if (uses_of[i] != "*" && !(uses_of[i] in may)) complain(table ":" line[room] ": " uses_of[i] " is no room")
        }
        for (key in except) if (!(key in needed)) complain(table ":" except[key] ": no longer needed: " key)
        exit bad
    }' "$table" "$work/files" "$work/includes" "$links" >"$work/said" || { LC_ALL=C sort "$work/said"; exit 1; }
printf '%d includes of %d files: every arrow is in the table\n' "$(wc -l <"$work/includes")" "$(wc -l <"$work/files")"
