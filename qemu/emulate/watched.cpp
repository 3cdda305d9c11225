#include "qemu/emulate/watched.hpp"

#include <fmt/format.h>

#include "base/failure.hpp"

namespace qemu {

std::uint32_t address_of(const Elf& elf, const std::string& symbol) {
    const auto address = elf.symbol(symbol);
    if (!address) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: expected the symbol {}", elf.path().string(), symbol));
    }
    return *address;
}

std::map<std::string, WatchedKernel> watched_kernels(const Elf& elf) {
    std::map<std::string, WatchedKernel> kernels;
    const std::uint32_t table = address_of(elf, "glsum_watched");
    const std::uint32_t count = elf.word(address_of(elf, "glsum_watched_count"));
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t row = table + 16 * i;
        kernels[elf.text(elf.word(row), elf.word(row + 4))] = {elf.word(row + 8) & ~1U, elf.word(row + 12) & ~1U};
    }
    return kernels;
}

Marks marks_of(const Elf& elf) {
    return {address_of(elf, "glsum_mark_row"), address_of(elf, "glsum_mark_on"), address_of(elf, "glsum_mark_off")};
}

}  // namespace qemu
