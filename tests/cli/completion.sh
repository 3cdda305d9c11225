#!/bin/sh
# Completion and the manual page: every command and option is completed in every shell that is here, with the words that may follow; the
# page is one that man reads. Arguments: the launcher on this build's programs, the source folder.
set -u
program=$1
source=$2
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
table=$source/cli/help/options.tsv

# completed WORD...: what bash offers for the last word.
"$program" completion bash >"$folder/bash" || fail "completion bash"
bash -n "$folder/bash" || fail "completion bash: no bash"
completed() {
    bash -c '. "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _glsum; printf "%s\n" "${COMPREPLY[@]}"' - "$folder/bash" "$@"
}
offers() {
    wanted=$1
    shift
    completed "$@" | grep -qxF -e "$wanted" || fail "bash: $*: expected $wanted among $(completed "$@" | head -c 300)"
}
sed '/^ *#/d; /^ *$/d; s/ *|.*//' "$source/cli/commands" >"$folder/all"
while read -r first second; do
    if [ -n "$second" ]; then offers "$second" glsum "$first" ""; else offers "$first" glsum ""; fi
done <"$folder/all"
tab=$(printf '\t')
cut -f 1 "$table" | sort -u >"$folder/commands"
while read -r words; do
    completed glsum $words - >"$folder/offered"
    awk -F "$tab" -v words="$words" '$1 == words && $2 ~ /^-/ { print $2 }' "$table" >"$folder/options"
    [ -s "$folder/options" ] || fail "$words: no options in $table"
    while read -r option; do grep -qxF -e "$option" "$folder/offered" || fail "bash: $words: expected $option"; done <"$folder/options"
done <"$folder/commands"
offers drive glsum diagnose ""
offers thermal glsum diagnose drive --domain ""
offers niopdt glsum identify --form ni
[ "$(completed glsum identify --form ni)" = niopdt ] || fail "bash: --form ni: expected niopdt alone"
(cd "$source" && completed glsum report READ) | grep -qx README.md || fail "bash: expected files where words may stand"
(cd "$source" && completed glsum gate --baseline CMakeL) | grep -qx CMakeLists.txt || fail "bash: expected files behind --baseline"

"$program" completion zsh >"$folder/_glsum" || fail "completion zsh"
if command -v zsh >/dev/null; then zsh -fc ". '$folder/_glsum' && whence -w _glsum" | grep -q function || fail "zsh cannot read it"; fi
"$program" completion fish >"$folder/glsum.fish" || fail "completion fish"
[ "$(grep -c -e ' -[ls] ' "$folder/glsum.fish")" -eq "$(awk -F "$tab" '$2 ~ /^-/' "$table" | wc -l)" ] || fail "fish: expected each option once"
if command -v fish >/dev/null; then
    fish -c "source '$folder/glsum.fish'; complete -C 'glsum identify --form ni'" | grep -q '^niopdt' || fail "fish: expected niopdt"
    fish -c "source '$folder/glsum.fish'; complete -C 'glsum diagnose drive --meth'; complete -C 'glsum diagnose drive --met'" |
        grep -q "^--metric" || fail "fish: expected --metric"
fi
expect 2 "expected a shell, bash, zsh or fish, found tcsh" completion tcsh
expect 2 "found nothing" completion

"$program" man >"$folder/glsum.1" || fail "man"
for text in '.TH GLSUM 1' '.SH NAME' '.B bench models' '.SH EXIT STATUS' 'not comparable' '.SH "GLSUM DIAGNOSE DRIVE"' '\-\-metric'; do
    grep -qF -e "$text" "$folder/glsum.1" || fail "the manual page: expected $text"
done
if command -v groff >/dev/null; then [ -z "$(groff -man -ww -Tutf8 "$folder/glsum.1" 2>&1 >/dev/null)" ] || fail "groff: $(groff -man -ww -Tutf8 "$folder/glsum.1" 2>&1 >/dev/null | head -n 3)"; fi
[ "$failures" -eq 0 ]
