#!/bin/sh
# Every schema that the product writes stands in docs/schemas.md, and none that it does not. Argument: the source folder.
set -eu
cd "$1"
# What the host hands its own firmware is no file of anybody's.
grep -rhoE '"glsum-[a-z]+-[0-9]+"' --include='*.cpp' --include='*.hpp' bench qemu gap drive cli | tr -d '"' | LC_ALL=C sort -u >"${TMPDIR:-/tmp}/schemas.$$"
trap 'rm -f "${TMPDIR:-/tmp}/schemas.$$"' EXIT
grep -oE 'glsum-[a-z]+-[0-9]+`' docs/schemas.md | tr -d '`' | LC_ALL=C sort -u | diff - "${TMPDIR:-/tmp}/schemas.$$" || {
    echo "docs/schemas.md: expected each schema that the product writes (>), and no other (<)"
    exit 1
}
