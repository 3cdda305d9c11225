#!/bin/sh
# The modelled cycles and bands that pages keep by hand are those of today: of a window of 600 taps as `bench` prints them now, of all else as
# docs/measured has them. Arguments: the glsum program, the source folder.
set -u
here=$(cd "$(dirname "$0")" && pwd)
for tool in arm-none-eabi-gcc qemu-system-arm perl; do
    command -v "$tool" >/dev/null 2>&1 && continue
    echo "no $tool"
    [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ] && exit 1
    exit 77
done
# Another compiler orders loads and stores otherwise: pages show what the one that docs/measured names gives.
of_pages=$(sed -n 's/^ *target compiler .* \([0-9]*\.[0-9]*\)\.[0-9]* [0-9]*$/\1/p' "$2/docs/measured/quick.md")
case $(arm-none-eabi-gcc -dumpversion) in
"${of_pages:?docs/measured/quick.md names no target compiler}".*) ;;
*) echo "pages are of GCC $of_pages" && exit 77 ;;
esac
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
kernels=$(sed -n 's/^| `\([a-z0-9]*_[a-z0-9]*_[fq][0-9c]*\)`.*/\1/p' "$2"/docs/*.md | sort -u | paste -sd, -)
"$1" bench --quick --kernels "$kernels" --orders 0.5 --taps 600 --targets m7,m4 --table all --out "$folder/run.json" >"$folder/run.txt" 2>"$folder/said" ||
    { cat "$folder/said"; exit 1; }
measured=$2/docs/measured
failures=0
# README's half derivative on both cores: cycles, at most, microseconds, bytes, share of real time.
"$1" choose --order 0.5 --step-s 0.001 --derivative-error 5% --band 0.05..80 --step-until 60 --target m7,m4 \
    >"$folder/choice.txt" 2>"$folder/said" || { cat "$folder/said"; exit 1; }
for core in Cortex-M7 Cortex-M4; do
    chosen=$(awk -v core=$core '$1 == core && /chosen$/ { print $5 + 0, $6 + 0, $7, $8, $9 }' "$folder/choice.txt")
    page=$(sed -n "s/^| $core[^|]*|[^|]*| \([^|]*\) | \([^|]*\) | \([^|]*\) | \([^|]*\) | \([0-9.]*\) % |\$/\1 \2 \3 \4 \5%/p" "$2/README.md")
    [ -n "$chosen" ] && [ "$chosen" = "$page" ] ||
        { echo "README.md: $core: expected ${chosen:-a choice}, found ${page:-no row}"; failures=$((failures + 1)); }
done
perl "$here/cycles.pl" "$2/README.md" "$2"/docs/*.md -- "$folder/run.txt" "$measured/models.md" "$measured/integrals.md" "$measured/front.md" ||
    failures=$((failures + 1))
[ "$failures" -eq 0 ]
