# For scripts about programs that know nothing of us: what they are made of, and how. Expects $folder.
foreign=$(CDPATH='' cd -- "$(dirname -- "$0")/../foreign" && pwd)
core="-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16"
for needed in arm-none-eabi-gcc qemu-system-arm; do
    command -v $needed >/dev/null 2>&1 && continue
    echo "no $needed"
    [ -n "${GLSUM_REQUIRE_FIRMWARE:-}" ] && exit 1
    exit 77
done

link_foreign() {  # OUT WORD...: on our map; OUT is a file of $folder
    out=$folder/$1
    shift
    # shellcheck disable=SC2086
    arm-none-eabi-gcc $core -O2 -g0 -ffreestanding -nostdlib -T "$foreign/map.ld" "$@" -lgcc -o "$out" 2>"$folder/said" ||
        { cat "$folder/said"; exit 1; }
}
