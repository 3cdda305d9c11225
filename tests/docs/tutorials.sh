#!/bin/sh
# The tutorials, as their readers would follow them, and what wrong input is answered: each page's files are written and its commands run in a folder of its own, and what
# it shows must come, in its order. Arguments: the launcher on this build's programs, the source folder.
set -u
here=$(cd "$(dirname "$0")" && pwd)
for tool in cc arm-none-eabi-gcc qemu-system-arm; do
    command -v "$tool" >/dev/null 2>&1 && continue
    echo "no $tool"
    [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ] && exit 1
    exit 77
done
program=$(readlink -f "$1")
source=$2
failures=0
for page in "$source"/docs/tutorials/*.md "$source/docs/wrong-input.md"; do
    folder=$(mktemp -d)
    ln -s "$program" "$folder/glsum"
    for room in targets results drive; do ln -s "$source/$room" "$folder/$room"; done
    ln -s "$(dirname "$(dirname "$(dirname "$program")")")" "$folder/build"
    (cd "$folder" && perl "$here/tutorials.pl" "$page") || failures=$((failures + 1))
    rm -rf "$folder"
done
[ "$failures" -eq 0 ]
