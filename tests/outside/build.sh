#!/bin/sh
# `find_package(glsum)` from another project: installs into a scratch folder, builds and runs a program there, on this machine and on
# the emulated target.
# Arguments: the source folder, a build folder whose library is installed, another of the emulated board.
set -eu
source=$1
build=$2
firmware=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$build" --prefix "$folder/prefix" >"$folder/log" || { cat "$folder/log"; exit 1; }
flags=$(sed -n 's/^CMAKE_CXX_FLAGS:[A-Z]*=//p' "$build/CMakeCache.txt")
cmake -S "$source/tests/outside" -B "$folder/build" -G Ninja -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_CXX_FLAGS="$flags" >"$folder/log" 2>&1 ||
    { cat "$folder/log"; exit 1; }
cmake --build "$folder/build" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
"$folder/build/outside"

# With the target's compiler alone: its own flags, start and linker script, the installed headers and library.
if [ ! -f "$firmware/CMakeCache.txt" ]; then
    echo "no firmware in $firmware"
    [ -z "${GLSUM_REQUIRE_FIRMWARE:-}" ] || exit 1
    exit 77
fi
cmake --install "$firmware" --prefix "$folder/target" >"$folder/log" || { cat "$folder/log"; exit 1; }
core='-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16'
arm-none-eabi-g++ $core -std=c++20 -O2 -fno-exceptions -fno-rtti -I"$folder/target/include" -nostartfiles -Wl,-T,"$source/tests/outside/board.ld" \
    -o "$folder/outside.elf" "$source/tests/outside/target.cpp" "$source/tests/outside/start.cpp" "$(find "$folder/target" -name libglsum.a)"
"$source/targets/mps2-an500/emulate" "$folder/outside.elf"
