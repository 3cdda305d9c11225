// An ELF file from anywhere.
#include "qemu/emulate/elf.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const int file = memfd_create("fuzz", MFD_CLOEXEC);
    fuzz::expect(file >= 0 && write(file, data, size) == static_cast<ssize_t>(size));
    fuzz::refused_or([&] {
        const qemu::Elf elf("/proc/self/fd/" + std::to_string(file));
        for (const char* name : {"reset_handler", "glsum_watched", ""}) {
            if (const auto address = elf.symbol(name)) {
                const qemu::Function* function = elf.function_at(*address);
                fuzz::expect(function == nullptr || *address - function->address < function->bytes);
                fuzz::refused_or([&] { (void)elf.text(elf.word(*address), elf.word(*address + 4)); });
            }
        }
        for (const std::uint32_t address : {0U, 3U, 0x20000000U, 0xFFFFFFFDU}) {
            (void)elf.function_at(address);
            fuzz::refused_or([&] { (void)elf.word(address); });
        }
    });
    close(file);
    return 0;
}
