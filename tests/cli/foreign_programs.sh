#!/bin/sh
# The lines of docs/foreign-programs.md, run as they stand there: in a folder where the project's are, with the programs that they name.
# Without a network: CoreMark comes from GLSUM_SHARED, and what Debian's source packages have is left out. With `all` behind the
# arguments everything is fetched as the page says.
# Arguments: the glsum program; the project's folder; the build folder of the emulated board's firmware; all.
set -u
program=$1 source=$2 firmware=$3 all=${4:-}
. "$(dirname "$0")/expect.sh"
. "$(dirname "$0")/../foreign/foreign.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
[ -e "$firmware/targets/libboard.a" ] || { echo "no firmware was built"; [ -z "${GLSUM_REQUIRE_FIRMWARE:-}" ] || exit 1; exit 77; }

mkdir "$folder/project" "$folder/project/build" "$folder/fetch"
ln -s "$source/targets" "$folder/project/targets"
ln -s "$firmware" "$folder/project/build/mps2-an500"
printf '#!/bin/sh\nexec "%s" "$@"\n' "$program" >"$folder/project/glsum"
printf '#!/bin/sh\ncp -r "%s/data/programs/coremark" . && chmod -R u+w coremark\n' "${GLSUM_SHARED:-}" >"$folder/fetch/git"
chmod +x "$folder/project/glsum" "$folder/fetch/git"
[ -n "$all" ] || PATH=$folder/fetch:$PATH
# Each fenced block of the page into a file of its own, in its order: NUMBER.sh, or a program's source by its name.
awk -v folder="$folder/project" '
    /^```[a-z]/ { out = $2 != "" ? folder "/" $2 : folder "/" ++blocks ".sh"; next }
    /^```$/ { out = ""; next }
    out != "" { print >out }' "$source/docs/foreign-programs.md"
cd "$folder/project" || exit 1
run() {  # PROGRAM: the block that names it runs behind the first, without an error
    block=$(grep -l -- "--elf $1.elf" [0-9]*.sh)
    [ -n "$block" ] || { fail "$1: expected its lines on the page"; return; }
    [ "$(wc -l <"$block")" -le 5 ] || fail "$1: expected at most five lines"
    cat 1.sh "$block" >both.sh
    sh -eu both.sh >said 2>&1 || fail "$1: expected its lines to run, found: $(tail -n 5 said)"
}
# What the page says of it is found: the cycles of a function or stretch and both ends of their band, to a hundredth (where code lies
# moves them a little); by another compiler than the page's, some.
of_page=$(sed -n 's/.*, by GCC \([0-9.]*\) of Debian.*/\1/p' "$source/docs/foreign-programs.md")
case $(arm-none-eabi-gcc -dumpversion) in "${of_page:?}".*) least=0.99 most=1.01 ;; *) least=0.5 most=2 ;; esac
says() {  # NAME
    cycles=$(awk -v name="$1 on" 'index($0, name) == 1 { on = 1 } on && /^model cycles/ { print $4, $7, $9; exit }' said)
    page=$(sed -n "s/^| \`$1\` | \([0-9 ]*\) | \([0-9 ]*\) to \([0-9 ]*\) .*/\1,\2,\3/p" "$source/docs/foreign-programs.md" | tr -d ' ' | tr , ' ')
    echo "${cycles:-0 0 0} ${page:-0 0 0} $least $most" |
        awk '{ for (i = 1; i <= 3; ++i) if (!($(i + 3) > 0 && $i > $7 * $(i + 3) && $i < $8 * $(i + 3))) exit 1 }' ||
        fail "$1: expected ${page:-cycles and band of the page}, found ${cycles:-nothing}"
}
run sort
says qsort
says printf
if [ -n "$all" ] || [ -e "${GLSUM_SHARED:-/nowhere}/data/programs/coremark" ]; then
    run coremark
    says start_time+0x0
fi
if [ -n "$all" ]; then
    run pack
    says LZ4_compress_default
    says LZ4_decompress_safe
fi
[ "$failures" -eq 0 ]
