#!/bin/sh
# The walk of docs/core-files.md from a board's serial log to a core file of one's own: its lines, run as they stand there, with recorded
# logs of made-up silicon for the board. And that those logs are what the model says with the figures that they claim.
# Arguments: the glsum program; the project's folder; the build folder of the emulated board's firmware.
set -u
program=$1 source=$2 firmware=$3
. "$(dirname "$0")/expect.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
if ! command -v qemu-system-arm >/dev/null 2>&1 || [ ! -e "$firmware/targets/silicon.elf" ]; then
    echo "no emulator, or no firmware"
    [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ] && exit 1
    exit 77
fi
case $(arm-none-eabi-gcc -dumpversion) in
    12.*) ;;
    *) echo "the logs are of GCC 12's code: judged with that compiler alone"; exit 0 ;;
esac
made_up=$source/results/silicon/made_up
project=$folder/project
mkdir -p "$project/build" "$folder/board"
ln -s "$firmware" "$project/build/mps2-an500"
printf '#!/bin/sh\nexec "%s" "$@"\n' "$program" >"$project/glsum"
# Where the board would be: what builds for it and sets up the port does nothing, and each flashing puts the next log there.
printf '#!/bin/sh\n' | tee "$folder/board/cmake" >"$folder/board/stty"
cat >"$folder/board/openocd" <<X
#!/bin/sh
[ -e "$folder/tty" ] && cp "$made_up/axi.log" "$folder/tty" || cp "$made_up/dtcm.log" "$folder/tty"
X
chmod +x "$project/glsum" "$folder/board"/*
# Each fenced block that has a name into a file of that name.
awk -v folder="$project" '/^```[a-z]+ / { out = folder "/" $2; next } /^```/ { out = ""; next } out != "" { print >out }' "$source/docs/core-files.md"
cd "$project" || exit 1
sed -i "s|/dev/ttyACM0|$folder/tty|" board
run() {  # BLOCK TEXT...: it runs, and says these
    PATH=$folder/board:$PATH sh -eu "./$1" >said 2>&1 || fail "$1: expected its lines to run, found: $(tail -n 5 said)"
    block=$1
    shift
    for text in "$@"; do grep -qF -e "$text" said || fail "$block: expected \"$text\", found: $(tail -n 60 said)"; done
}
run board
[ "$(grep -c '^[a-z].*,[0-9]*,216mhz' board.csv)" = 88 ] || fail "board.csv: expected 88 rows: $(cat board.csv)"
# What the page prints, it says.
sed -n '/^    unknown: the gap/,/^$/s/^    //p' "$source/docs/core-files.md" >page
[ "$(wc -l <page)" = 5 ] || fail "expected five lines of the diagnosis on the page"
run shipped "36 of 88 rows within"
while IFS= read -r line; do grep -qF -e "${line#  }" said || fail "the page has \"$line\", which was not said: $(cat said)"; done <page
run trying "4: 0.0 %, worst 32.3 %" "8: 0.0 %, worst 13.8 %" "11: 0.0 %, worst 0.0 %" "12: 0.0 %, worst 4.6 %"
run own "88 of 88 rows within" "no_gap: the gap to my-board.toml" "biquad_step on my-board, code in flash, data in dtcm: 1000 calls"

# The logs are the model's words with made_up.toml, to the rounding of a counter.
for log in dtcm axi; do
    tr -d '\r' <"$made_up/$log.log" >rows.csv
    expect 0 "44 of 44 rows within" silicon "$project/rows.csv" --core "$made_up/made_up.toml"
    awk '/flash_cached/ && NF >= 9 && $3 ~ /dtcm|axi/ && $5 ~ /^[0-9]+$/ { n++; d = $5 - $6; if (d > 0.5 || d < -0.5) { print; bad = 1 } } END { exit bad || n != 44 }' "$folder/said" ||
        fail "$log.log: expected what made_up.toml says"
done
expect 2 "no such core file" silicon "$project/board.csv" --core "$folder/none.toml"
expect 2 "no such core file" diagnose cycles --measured "$project/board.csv" --core "$folder/none.toml"
[ "$failures" -eq 0 ]
