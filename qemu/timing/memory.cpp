#include "qemu/timing/memory.hpp"

#include <algorithm>

namespace timing {
namespace {

// As associative as it holds lines.
Cache accelerator_of(const Figures& f) {
    return {f.memory_art_lines * f.memory_flash_line_bytes, f.memory_art_lines, f.memory_flash_line_bytes};
}

}  // namespace

Memory::Memory(const Figures& f, const Placement& placement)
    : figures_(f),
      code_place_(place_named(name_of(placement.code))),
      data_place_(place_named(name_of(placement.data))),
      ranges_(placement.ranges),
      instructions_(f.cache_instruction_bytes, f.cache_instruction_ways, f.cache_line_bytes,
                    f.mechanisms.random_replacement),
      data_(f.cache_data_bytes, f.cache_data_ways, f.cache_line_bytes, f.mechanisms.random_replacement),
      accelerator_(accelerator_of(f)),
      wait_states_((f.memory_clock_hz / std::max<std::int64_t>(1, f.memory_bus_clocks) - 1) /
                   std::max<std::int64_t>(1, f.memory_flash_hz_per_wait_state)),
      nothing_waits_(wait_states_ == 0 && f.memory_bus_overhead == 0 && f.memory_bus_clocks <= 1) {}

Place Memory::place_among_ranges(std::uint32_t address) const {
    const auto found = std::find_if(ranges_.rbegin(), ranges_.rend(), [&](const PlacedRange& range) {
        return range.begin <= address && address < range.end;
    });
    return found != ranges_.rend() ? found->place : is_data(address) ? data_place_ : code_place_;
}

Delay Memory::read_flash(std::uint32_t address, bool fetch) {
    const auto line = static_cast<std::uint32_t>(address / figures_.memory_flash_line_bytes);
    const std::int64_t read = (wait_states_ + 1) * figures_.memory_bus_clocks;
    if (accelerator_.on()) {
        const bool ahead = figures_.memory_art_prefetch != 0 && line == prefetched_line_;
        prefetched_line_ = line + 1;
        if (accelerator_.touch(address)) {
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
    const bool flash = place_of(address) == Place::flash;
    if (instructions_.on() && !accelerator_.on()) {
        if (instructions_.touch(address)) {
            return {};
        }
        const Delay delay = flash ? read_flash(address, true) : Delay{sram_line()};
        return {delay.cycles, Effect::icache_misses};
    }
    return flash ? read_flash(address, true) : Delay{sram_line(), Effect::flash_wait_states};
}

bool Memory::fetches_freely(std::uint32_t first, std::uint32_t last) const {
    if (std::any_of(ranges_.begin(), ranges_.end(), [&](const PlacedRange& range) {
            return (range.begin > first && range.begin <= last) || (range.end > first && range.end <= last);
        })) {
        return false;
    }
    if (in_tcm(first)) {
        return in_tcm(last);
    }
    return instructions_.on() && !accelerator_.on() && !in_tcm(last) && instructions_.newest(first, last);
}

Delay Memory::load_from_afar(std::uint32_t address) {
    const bool flash = place_of(address) == Place::flash;
    if (flash && accelerator_.on()) {
        return read_flash(address, false);
    }
    if (data_.on()) {
        if (data_.touch(address)) {
            return {};
        }
        return {flash ? read_flash(address, false).cycles : sram_line(), Effect::dcache_misses};
    }
    return flash ? read_flash(address, false) : Delay{sram_line(), Effect::dcache_misses};
}

Delay Memory::store(std::uint32_t address) {
    if (nothing_waits_ || place_of(address) != Place::axi) {  // a flash is not written by stores
        return {};
    }
    if (data_.on() && data_.touch(address)) {
        return {};
    }
    return {sram_line(), Effect::dcache_misses};
}

std::int64_t Memory::longest_fetch() const {
    if (code_place_ <= Place::dtcm && data_place_ <= Place::dtcm &&
        std::all_of(ranges_.begin(), ranges_.end(), [](const PlacedRange& r) { return r.place <= Place::dtcm; })) {
        return 0;
    }
    const std::int64_t flash = (wait_states_ + 1 + figures_.memory_bus_overhead) * figures_.memory_bus_clocks;
    return std::max(flash, sram_line());
}

bool Memory::has_banks(std::uint32_t address) const {
    const Place place = place_of(address);
    return place == Place::dtcm || (place != Place::itcm && data_.on() && !accelerator_.on());
}

}  // namespace timing
