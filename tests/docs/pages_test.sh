#!/bin/sh
# pages.sh on small pages of its own: what it must find, and what it must leave alone. Argument: the project's folder.
set -u
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
pages=$folder/pages

# begin: a page at the top, one of a room and one of docs, without a fault.
begin() {
    rm -rf "$pages" && mkdir -p "$pages/docs" "$pages/room"
    printf '# top\n\nThe [room](room/README.md).\n' >"$pages/README.md"
    printf '# room\n\n## A word\n\nShort.\n' >"$pages/room/README.md"
    printf '# docs\n\nThe [word](../room/README.md#a-word).\n' >"$pages/docs/page.md"
}
# words N: so many, without a blank at the end.
words() { awk -v n="$1" 'BEGIN { printf "w"; for (i = 1; i < n; ++i) printf " w" }'; }
# write TEXT: as the room's page behind its title.
write() { begin; printf '# room\n\n## A word\n\n%s\n' "$1" >"$pages/room/README.md"; }
# expect STATUS [TEXT]
expect() {
    said=$(sh "$source/tests/docs/pages.sh" "$pages" 2>&1)
    found=$?
    case "$found: $said" in "$1: "*"${2-}"*) return ;; esac
    echo "expected status $1 and \"${2-}\"; found status $found and: $said"
    cat "$pages/room/README.md"
    failures=$((failures + 1))
}

begin
expect 0
# Links, anchors, titles.
write 'The [top](../READ.md).'
expect 1 'room/README.md:5: expected a link that leads somewhere'
write 'The [docs](../docs/page.md#words).'
expect 1 'room/README.md:5: expected an anchor that is there'
begin
printf 'room\n' >"$pages/docs/page.md"
expect 1 'docs/page.md:1: expected the title'
# Length.
write "$(awk 'BEGIN { for (i = 0; i < 76; ++i) print "Short." }')"
expect 0
write "$(awk 'BEGIN { for (i = 0; i < 77; ++i) print "Short." }')"
expect 1 'expected at most 80 lines, found 81'
begin
{ echo '# top' && awk 'BEGIN { for (i = 0; i < 107; ++i) print "a b c d e f g h i j k l m n." }'; } >"$pages/README.md"
expect 0
echo 'Two more.' >>"$pages/README.md"
expect 1 'expected at most 1500 words, found 1502'

# Sentences: 25 words pass, 26 do not, whatever joins them.
write "$(words 25). $(words 25)? $(words 25)! $(words 25)"
expect 0
write "Short. $(words 26)."
expect 1 'room/README.md:5: expected a sentence of at most 25 words, found 26'
for joint in ';' ':' ',' ' Fig.' ' ...'; do
    write "$(words 13)$joint $(words 13)."
    expect 1 'a sentence of at most 25 words'
done
write "$(printf 'Short.\n%s\n%s' "$(words 13);" "$(words 13).")"
expect 1 'room/README.md:6: expected a sentence of at most 25 words, found 26'
# A list, code and a table end the sentence before them; the words of code and tables do not count.
write "$(printf '%s:\n- %s\n- %s' "$(words 25)" "$(words 25)" "$(words 25)")"
expect 0
write "- short: $(words 25)"
expect 1 'a sentence of at most 25 words'
write "$(printf '%s:\n\n    %s\n\n%s' "$(words 25)" "$(words 30)" "$(words 25)")"
expect 0
write "$(printf '%s:\n```\n%s\n```\n%s:\n\n| %s |\n' "$(words 25)" "$(words 30)" "$(words 25)" "$(words 30)")"
expect 0
write "$(words 24) \`$(words 9). $(words 9)\`."
expect 0
# Other pages: 35 words, and what commands print any number.
for page in docs/page.md docs/deep/page.md CHANGELOG.md; do
    begin
    mkdir -p "$pages/docs/deep"
    printf '# page\n\n%s.\n' "$(words 35)" >"$pages/$page"
    expect 0
    printf '# page\n\n%s; %s.\n' "$(words 18)" "$(words 18)" >"$pages/$page"
    expect 1 "$page:3: expected a sentence of at most 35 words, found 36"
done
begin
mkdir -p "$pages/docs/measured"
printf '# page\n\n%s.\n' "$(words 90)" >"$pages/docs/measured/page.md"
expect 0
[ "$failures" -eq 0 ]
