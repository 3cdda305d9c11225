#!/bin/sh
# All sources of kernels/ are taken by clang, too, which is stricter than GCC about templates (Debian package clang).
# So is the one of bench/ that asks every kernel for what it holds: no source of kernels/ instantiates that.
# Arguments: the source folder, Eigen's include folder, xsimd's include folder.
set -u
source=$1
set -- -idirafter "$2" -idirafter "$3"
if ! command -v clang++ >/dev/null 2>&1; then
    echo "not installed: clang++"
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
count=0
find "$source/kernels/glsum" "$source/bench/choose/kernel_run.cpp" -name '*.cpp' >"$folder/sources"
while IFS= read -r file; do
    count=$((count + 1))
    clang++ -fsyntax-only -std=c++20 -ffp-contract=off -Wall -Wextra -Werror -DGLSUM_SIMD -DGLSUM_SIMD_ARCHITECTURE=xsimd::sse2 \
        -I"$source/kernels" -I"$source" -I"$source/bench" "$@" "$file" >"$folder/said" 2>&1 && continue
    grep -m 1 'error:' "$folder/said" >>"$folder/refused" || head -n 1 "$folder/said" >>"$folder/refused"
done <"$folder/sources"
[ ! -e "$folder/refused" ] || cat "$folder/refused"
[ "$count" -ge 20 ] || echo "expected 20 sources or more, found $count"
[ "$count" -ge 20 ] && [ ! -e "$folder/refused" ]
