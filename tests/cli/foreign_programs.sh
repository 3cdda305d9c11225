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
# What the page says of it is found: the cycles of a function or stretch, to a hundredth (where code lies moves
# them a little); by another compiler than the page's, some.
of_page=$(sed -n 's/.*, by GCC \([0-9.]*\) of Debian.*/\1/p' "$source/docs/foreign-programs.md")
case $(arm-none-eabi-gcc -dumpversion) in "${of_page:?}".*) least=0.99 most=1.01 ;; *) least=0.5 most=2 ;; esac
says() {  # NAME
    cycles=$(awk -v name="$1 on" 'index($0, name) == 1 { on = 1 } on && /^model cycles/ { print $4; exit }' said)
    page=$(sed -n "s/^| \`$1\` | \([0-9 ]*\) .*/\1/p" "$source/docs/foreign-programs.md" | tr -d ' ')
    echo "${cycles:-0} ${page:-0} $least $most" | awk '{ exit !($2 > 0 && $1 > $3 * $2 && $1 < $4 * $2) }' ||
        fail "$1: expected ${page:-the cycles of the page}, found ${cycles:-nothing}"
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
