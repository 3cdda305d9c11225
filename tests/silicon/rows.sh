#!/bin/sh
# rows.sh FIRMWARE FOLDER [GROUP...]: builds the programs of others whose cycles were measured on silicon, and writes
# FOLDER/GROUP.csv and FOLDER/all.csv for `glsum silicon --rows`. GROUP: aes, coremark, dhrystone, fir; all of them unless given.
# Their sources stay where GLSUM_SHARED says that they lie; without it there is nothing to do (77). FIRMWARE: the build
# folder of the emulated board's firmware.
set -eu
if [ -z "${GLSUM_SHARED:-}" ]; then
    echo "GLSUM_SHARED is not set: no measured programs of others"
    exit 77
fi
command -v arm-none-eabi-g++ >/dev/null 2>&1 || { echo "no arm-none-eabi-g++"; exit 77; }
here=$(cd "$(dirname "$0")" && pwd)
targets=$here/../../targets
firmware=$1 folder=$2
shift 2
[ $# -gt 0 ] || set -- aes coremark dhrystone fir
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
core="-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16"
header=elf,function,core,code,data,measured,per,group

# shellcheck disable=SC2086 # the core's flags are words
link() {  # ELF OBJECT...
    elf=$1
    shift
    arm-none-eabi-g++ $core -nostartfiles -Wl,--gc-sections -T "$targets/mps2-an500/memory.ld" -T "$targets/cortex-m7/sections.ld" \
        "$@" "$firmware/targets/libboard.a" -o "$elf"
}

# shellcheck disable=SC2086
# Hand-written assembly: jnk0le/cortexm-AES at the commits whose README said what each function takes.
aes() {
    from=$GLSUM_SHARED/data/silicon/aes
    into=$folder/aes
    rm -rf "$into"
    mkdir -p "$into"
    # Commas within quotes are none that part cells; lines end as on another system.
    awk -F'"' 'BEGIN {OFS = ""} {sub(/\r$/, "")} /^#/ || /^commit,/ {next} {for (i = 2; i <= NF; i += 2) gsub(/,/, ";", $i); print}' \
        "$from/rows.csv" >"$into/rows"
    {
        echo "# jnk0le/cortexm-AES (MIT) on an STM32H743, by its README at each commit: warm, code in ITCM, tables and data in DTCM"
        echo "$header"
    } >"$folder/aes.csv"
    nth=0
    while IFS=, read -r commit function kind bits measured unit source schedule_source schedule tables; do
        nth=$((nth + 1))
        case $kind in
            "key schedule") number=0 ;;
            "decryption key schedule") number=1 ;;
            block) number=2 ;;
            "block; unrolled") number=3 ;;
            "counter mode; 512 blocks") number=4 ;;
            "counter mode; 512 blocks; unrolled") number=5 ;;
            *) echo "$from/rows.csv: kind: expected one that call.cpp knows, found $kind" >&2; exit 2 ;;
        esac
        case $unit in
            "cycles a call") per=1 ;;
            "cycles a byte") per=8192 ;;
            *) echo "$from/rows.csv: unit: expected cycles a call or a byte, found $unit" >&2; exit 2 ;;
        esac
        same=
        [ "$function" != "$schedule" ] || same=-DSAMEKS
        arm-none-eabi-g++ $core -O2 -fno-exceptions -fno-rtti -DFN="$function" -DKS="$schedule" -DKIND=$number -DKEYBITS="$bits" \
            -DCALLS=16 $same -c "$from/call.cpp" -o "$into/call.o"
        objects=$into/call.o
        for one in "$source" "$schedule_source"; do
            object=$into/$(echo "$one" | tr '/.' '__').o
            # What they include is named by its place in the repository, and lies beside them here.
            sed 's|\.include ".*/|.include "|' "$from/$one" >"$into/one.S"
            [ -e "$object" ] || arm-none-eabi-gcc $core -Wa,-I,"$from/$(dirname "$one")" -c "$into/one.S" -o "$object"
            case " $objects " in *" $object "*) ;; *) objects="$objects $object" ;; esac
        done
        object=$into/$(echo "$tables" | tr '/.' '__').o
        [ -e "$object" ] || arm-none-eabi-gcc $core -O2 -fdata-sections -c "$from/$tables" -o "$object"
        link "$into/$nth.elf" $objects "$object"
        echo "aes/$nth.elf,$function,stm32h747-dtcm,itcm,dtcm,$measured,$per,jnk0le/$commit" >>"$folder/aes.csv"
    done <"$into/rows"
}

# Compiled integer code: EEMBC's CoreMark, 10 iterations. 4.07 to 4.09 CoreMark/MHz by GCC -O3 on STM32F767 and i.MX RT1062.
coremark() {
    from=$GLSUM_SHARED/data/programs/coremark
    into=$folder/coremark
    rm -rf "$into"
    mkdir -p "$into"
    for source in core_list_join core_main core_matrix core_state core_util; do
        # shellcheck disable=SC2086
        arm-none-eabi-gcc $core -O3 -DPERFORMANCE_RUN=1 -DITERATIONS=10 -DCOMPILER_FLAGS='"-O3"' -Dmain=coremark_main -include "$here/coremark_port.h" -I "$from" \
            -I "$from/barebones" -c "$from/$source.c" -o "$into/$source.o"
    done
    # shellcheck disable=SC2086
    arm-none-eabi-g++ $core -std=c++20 -O2 -fno-exceptions -fno-rtti -I "$targets" -c "$here/coremark_port.cpp" -o "$into/port.o"
    link "$folder/coremark/coremark.elf" "$into"/*.o
    {
        echo "# CoreMark, 10^6 / 4.08 cycles an iteration: by GCC -O3 of other versions than this one"
        echo "$header"
        echo "coremark/coremark.elf,iterate,stm32h747-dtcm,itcm,dtcm,245098,10,coremark"
    } >"$folder/coremark.csv"
}

# Calls, strings, records: 100 turns. 2.14 DMIPS/MHz are 10^6 / (2.14 * 1757) cycles a turn of Dhrystone.
# shellcheck disable=SC2086
dhrystone() {
    into=$folder/dhrystone
    rm -rf "$into"
    mkdir -p "$into"
    echo 'extern "C" int dhrystone_main(int); int firmware_main() { return dhrystone_main(100) == -1; }' >"$into/main.cpp"
    arm-none-eabi-gcc $core -O2 -c "$here/dhrystone.c" -o "$into/dhrystone.o"
    arm-none-eabi-g++ $core -O2 -fno-exceptions -fno-rtti -c "$into/main.cpp" -o "$into/main.o"
    link "$into/dhrystone.elf" "$into/dhrystone.o" "$into/main.o"
    {
        echo "# a mix as Dhrystone's: Arm's figure for the Cortex-M7, of its own compiler, without inlining"
        echo "$header"
        echo "dhrystone/dhrystone.elf,dhrystone_turns,stm32h747-dtcm,itcm,dtcm,265.96,100,dhrystone"
    } >"$folder/dhrystone.csv"
}

# The loops behind results/silicon, a program a length. Measured: less the counter reads and the cache's maintenance, as the
# core file has them, since a program's rows are of calls alone.
# shellcheck disable=SC2086
fir() {
    into=$folder/fir
    rm -rf "$into"
    mkdir -p "$into"
    figure() { sed -n "s/^$1 = { value = \([0-9]*\),.*/\1/p" "$here/../../qemu/cores/_stm32h747.toml"; }
    arm-none-eabi-gcc $core -c "$targets/firmware/silicon_loops.S" -o "$into/loops.o"
    sed '/^#/d; /^kernel,/d' "$here/../../results/silicon/h747_per_sample_fir.csv" >"$into/rows"
    {
        echo "# one pass of a filter over a delay line in each of two formats, on an STM32H747: results/silicon/h747_per_sample_fir.csv"
        echo "$header"
    } >"$folder/fir.csv"
    while IFS=, read -r kernel _ data maintenance taps cycles; do
        if [ ! -e "$into/$kernel-$taps.elf" ]; then
            arm-none-eabi-g++ $core -O2 -fno-exceptions -fno-rtti -DLOOP="glsum_silicon_$kernel" -DTAPS="$taps" -c "$here/fir_call.cpp" -o "$into/call.o"
            link "$into/$kernel-$taps.elf" "$into/call.o" "$into/loops.o"
        fi
        echo "fir/$kernel-$taps.elf,glsum_silicon_$kernel,stm32h747-dtcm,flash,$data,$((cycles - $(figure counter_reads) - maintenance * $(figure maintenance))),1,fir/$kernel"
    done <"$into/rows" >>"$folder/fir.csv"
}

{
    echo "# All groups in one; the assembly by its commits"
    echo "$header"
} >"$folder/all.csv"
for group in "$@"; do
    case $group in
        aes | coremark | dhrystone | fir) "$group" ;;
        *) echo "rows.sh: expected aes, coremark, dhrystone or fir, found $group" >&2; exit 2 ;;
    esac
    sed '/^#/d; /^elf,/d' "$folder/$group.csv" >>"$folder/all.csv"
done
