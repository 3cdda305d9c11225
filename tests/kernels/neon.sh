#!/bin/sh
# The vector kernels compiled for AArch64 and run under its emulator, where both are installed (Debian packages
# g++-aarch64-linux-gnu, qemu-user). Arguments: the source folder, xsimd's include folder.
set -eu
source=$1
compiler=aarch64-linux-gnu-g++
emulator=$(command -v qemu-aarch64 || command -v qemu-aarch64-static || true)
if ! command -v $compiler >/dev/null 2>&1 || [ -z "$emulator" ]; then
    echo "not installed: $compiler or qemu-aarch64"
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Only xsimd: the host's other headers are not AArch64's.
mkdir "$folder/include"
ln -s "$2/xsimd" "$folder/include/xsimd"
$compiler -static -std=c++20 -O2 -ffp-contract=off -DGLSUM_SIMD -DGLSUM_SIMD_ARCHITECTURE=xsimd::neon64 \
    -I"$source" -I"$source/kernels" -I"$folder/include" -o "$folder/neon" \
    "$source/tests/kernels/neon.cpp" "$source/kernels/glsum/window/simd_dot.cpp" "$source/kernels/glsum/window/simd_dot_arch.cpp" \
    "$source/kernels/glsum/lookahead/simd_block.cpp" "$source/kernels/glsum/lookahead/simd_block_arch.cpp" \
    "$source/kernels/glsum/sum.cpp" "$source/kernels/glsum/weights.cpp"
"$emulator" "$folder/neon"
