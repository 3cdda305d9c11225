#include "qemu/timing/memory.hpp"

#include <algorithm>

namespace timing {
namespace {

// As associative as it holds lines.
Cache accelerator_of(const Figures& f) {
    return {f.memory_art_lines * f.memory_flash_line_bytes, f.memory_art_lines, f.memory_flash_line_bytes};
}

}  // namespace

Memory::Memory(const Figures& f, Placement placement)
    : figures_(f),
      placement_(placement),
      instructions_(f.cache_instruction_bytes, f.cache_instruction_ways, f.cache_line_bytes),
      data_(f.cache_data_bytes, f.cache_data_ways, f.cache_line_bytes),
      accelerator_(accelerator_of(f)),
      wait_states_((f.memory_clock_hz / std::max<std::int64_t>(1, f.memory_bus_clocks) - 1) /
                   std::max<std::int64_t>(1, f.memory_flash_hz_per_wait_state)) {}

Delay Memory::read_flash(std::uint32_t address, bool fetch) {
    const auto line = static_cast<std::uint32_t>(address / figures_.memory_flash_line_bytes);
    const std::int64_t read = (wait_states_ + 1) * figures_.memory_bus_clocks;
    if (accelerator_.on()) {
        const bool ahead = figures_.memory_art_prefetch != 0 && line == prefetched_line_;
        prefetched_line_ = line + 1;
        if (accelerator_.touch(address, false).hit) {
            return {0, Effect::flash_wait_states};
        }
        // What is read ahead has been under way since the line before was begun: eight words of 4 bytes.
        const std::int64_t hidden = ahead ? figures_.memory_flash_line_bytes / figures_.fetch_bytes : 0;
        return {std::max<std::int64_t>(0, read - hidden), Effect::flash_wait_states};
    }
    std::uint32_t& open = fetch ? open_fetch_line_ : open_data_line_;
    const std::int64_t bus = figures_.memory_bus_overhead * figures_.memory_bus_clocks;
    const bool same = line == open;
    open = line;
    return {bus + (same ? 0 : read), Effect::flash_wait_states};
}

std::int64_t Memory::sram_line() const {
    // The critical word comes first: its beats, not the whole line's.
    const std::int64_t beats = std::max<std::int64_t>(1, 8 / figures_.memory_sram_beat_bytes);
    return (figures_.memory_bus_overhead + beats) * figures_.memory_bus_clocks;
}

Delay Memory::fetch(std::uint32_t address) {
    if (in_tcm(address)) {
        return {};
    }
    const bool flash = !is_data(address) && placement_.code == CodePlace::flash;
    if (instructions_.on() && !accelerator_.on()) {
        if (instructions_.touch(address, false).hit) {
            return {};
        }
        const Delay delay = flash ? read_flash(address, true) : Delay{sram_line()};
        return {delay.cycles, Effect::icache_misses};
    }
    return flash ? read_flash(address, true) : Delay{sram_line(), Effect::flash_wait_states};
}

bool Memory::fetches_freely(std::uint32_t first, std::uint32_t last) const {
    if (in_tcm(first)) {
        return in_tcm(last);
    }
    return instructions_.on() && !accelerator_.on() && !in_tcm(last) && instructions_.newest(first, last);
}

Delay Memory::load_from_afar(std::uint32_t address) {
    const bool flash = !is_data(address) && placement_.code == CodePlace::flash;
    if (flash && accelerator_.on()) {
        return read_flash(address, false);
    }
    if (data_.on()) {
        const Cache::Touch touch = data_.touch(address, false);
        if (touch.hit) {
            return {};
        }
        return {flash ? read_flash(address, false).cycles : sram_line(), Effect::dcache_misses};
    }
    return flash ? read_flash(address, false) : Delay{sram_line(), Effect::dcache_misses};
}

Delay Memory::store(std::uint32_t address) {
    if (!is_data(address) || placement_.data == DataPlace::dtcm) {
        return {};
    }
    if (data_.on() && data_.touch(address, true).hit) {
        return {};
    }
    return {sram_line(), Effect::dcache_misses};
}

std::int64_t Memory::longest_fetch() const {
    if (placement_.code == CodePlace::itcm && placement_.data == DataPlace::dtcm) {
        return 0;
    }
    const std::int64_t flash = (wait_states_ + 1 + figures_.memory_bus_overhead) * figures_.memory_bus_clocks;
    return std::max(flash, sram_line());
}

bool Memory::has_banks(std::uint32_t address) const {
    if (in_dtcm(address)) {
        return true;
    }
    const bool itcm = !is_data(address) && placement_.code == CodePlace::itcm;
    return data_.on() && !itcm && !accelerator_.on();
}

}  // namespace timing
