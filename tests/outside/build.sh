#!/bin/sh
# The library in another project: installed for this machine and for the target under one prefix and found by find_package and by
# pkg-config, or as a folder of that project; each program runs, and all say the same bits.
# Arguments: the source folder, a build folder whose library is installed, another of the emulated board.
set -eu
source=$1
build=$2
firmware=$3
here=$source/tests/outside
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

quietly() { "$@" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }; }
# project NAME CMAKE-SETTING...: the stranger's project, configured and built in a folder of that name
project() {
    name=$1
    shift
    quietly cmake -S "$here" -B "$folder/$name" -G Ninja "$@"
    quietly cmake --build "$folder/$name"
}
# says NAME PROGRAM...: what it says is what the first one said
says() {
    name=$1
    shift
    "$@" >"$folder/$name.txt" 2>&1 || { status=$?; cat "$folder/$name.txt"; echo "$name: exit $status"; exit 1; }
    [ -f "$folder/first" ] || cp "$folder/$name.txt" "$folder/first"
    diff "$folder/first" "$folder/$name.txt" || { echo "$name: expected the same bits"; exit 1; }
    echo "$name: as the first"
}
prefix=$folder/prefix
flags=$(sed -n 's/^CMAKE_CXX_FLAGS:[A-Z]*=//p' "$build/CMakeCache.txt")
quietly cmake --install "$build" --prefix "$prefix"

project host-package -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="$flags"
says host-package "$folder/host-package/outside"
cat "$folder/first"
"$folder/host-package/designed"
"$folder/host-package/filtered"
export PKG_CONFIG_LIBDIR="$prefix/lib/pkgconfig"
quietly c++ $flags -std=c++20 $(pkg-config --cflags glsum-model) -o "$folder/by-pkg-config" "$here/outside.cpp" "$here/say.cpp" $(pkg-config --libs glsum-model)
says host-pkg-config "$folder/by-pkg-config"
quietly c++ $flags -std=c++20 $(pkg-config --cflags glsum-design) -o "$folder/designed" "$here/designed.cpp" $(pkg-config --libs glsum-design)
"$folder/designed"
quietly c++ $flags -std=c++20 $(pkg-config --cflags glsum-filters) -o "$folder/filtered" "$here/filtered.cpp" $(pkg-config --libs glsum-filters)
"$folder/filtered"
project host-folder -DGLSUM_SOURCE="$source" -DCMAKE_CXX_FLAGS="$flags"
says host-folder "$folder/host-folder/outside"
"$folder/host-folder/designed"
"$folder/host-folder/filtered"

# A combination without a body is refused by the compiler, and in one line.
if c++ -std=c++20 $(pkg-config --cflags glsum) -fsyntax-only "$here/unregistered.cpp" 2>"$folder/refused"; then
    echo "unregistered.cpp: expected an error"
    exit 1
fi
grep -q 'error: static assertion failed: no such kernel: glsum/registry.def' "$folder/refused" || { cat "$folder/refused"; exit 1; }
[ "$(grep -c 'error:' "$folder/refused")" = 1 ] || { cat "$folder/refused"; exit 1; }

# With the target's compiler alone: its own toolchain file, flags, start and linker script.
if [ ! -f "$firmware/CMakeCache.txt" ]; then
    echo "no firmware in $firmware"
    [ -z "${GLSUM_REQUIRE_FIRMWARE:-}" ] || exit 1
    exit 77
fi
quietly cmake --install "$firmware" --prefix "$prefix"
single='-mfloat-abi=hard -mfpu=fpv5-sp-d16'
double='-mfloat-abi=hard -mfpu=fpv5-d16'
arm="-DCMAKE_TOOLCHAIN_FILE=$here/arm.cmake"
emulate=$source/targets/mps2-an500/emulate
project target-package "$arm" -DFPU="$single" -DCMAKE_PREFIX_PATH="$prefix"
says target-package "$emulate" "$folder/target-package/outside"
export PKG_CONFIG_LIBDIR="$prefix/lib/arm-none-eabi/cortex-m7-single/pkgconfig"
quietly arm-none-eabi-g++ -mcpu=cortex-m7 -mthumb $single -std=c++20 -O2 -Wno-psabi -fno-exceptions -fno-rtti $(pkg-config --cflags glsum-model) -nostartfiles \
    -Wl,-T,"$here/board.ld" -o "$folder/by-pkg-config.elf" "$here/outside.cpp" "$here/start.cpp" $(pkg-config --libs glsum-model)
says target-pkg-config "$emulate" "$folder/by-pkg-config.elf"
project target-folder-soft "$arm" -DFPU=-mfloat-abi=soft -DGLSUM_SOURCE="$source"
says target-folder-soft "$emulate" "$folder/target-folder-soft/outside"
project target-folder-double "$arm" -DFPU="$double" -DGLSUM_SOURCE="$source"
says target-folder-double "$emulate" "$folder/target-folder-double/outside"

# A unit that no library was installed for is named, with those that there are.
if cmake -S "$here" -B "$folder/refused-unit" -G Ninja "$arm" -DFPU="$double" -DCMAKE_PREFIX_PATH="$prefix" >"$folder/refused" 2>&1; then
    echo "find_package: expected no library for a double-precision unit"
    exit 1
fi
tr -s ' \n' ' ' <"$folder/refused" | grep -q 'ask for the library of cortex-m7-double; installed: .*cortex-m7-single.*host' || { cat "$folder/refused"; exit 1; }
echo "a unit that is not there: refused"
