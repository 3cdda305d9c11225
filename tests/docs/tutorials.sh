#!/bin/sh
# The tutorials, as their readers would follow them: each page's files are written and its commands run in a folder of its own, and what
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
for page in "$source"/docs/tutorials/*.md; do
    folder=$(mktemp -d)
    ln -s "$program" "$folder/glsum"
    ln -s "$source/targets" "$folder/targets"
    ln -s "$(dirname "$(dirname "$(dirname "$program")")")" "$folder/build"
    (cd "$folder" && perl "$here/tutorials.pl" "$page") || failures=$((failures + 1))
    rm -rf "$folder"
done
[ "$failures" -eq 0 ]
