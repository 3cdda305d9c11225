// Where an address lies in the modelled chip, and how long its memory takes.
#pragma once

#include <cstdint>
#include <vector>

#include "qemu/timing/cache.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/effects.hpp"

namespace timing {

/// Extra cycles of one access, and why.
struct Delay {
    std::int64_t cycles = 0;
    Effect effect = Effect::dcache_misses;
};

class Memory {
public:
    Memory(const Figures& figures, const Placement& placement);

    /// Extra cycles before the bytes of one fetch are there. \param address of its first byte
    Delay fetch(std::uint32_t address);
    /// Whether fetching these bytes takes no extra cycle and changes nothing here: TCM, and lines that their sets of
    /// the instruction cache had last.
    [[nodiscard]] bool fetches_freely(std::uint32_t first, std::uint32_t last) const;
    /// Extra cycles of a load, from the line that holds its first byte.
    Delay load(std::uint32_t address) { return in_tcm(address) ? Delay{} : load_from_afar(address); }
    /// Extra cycles that a store takes to leave the store buffer.
    Delay store(std::uint32_t address);

    /// The most that `fetch` ever says.
    [[nodiscard]] std::int64_t longest_fetch() const;

    /// Whether loads of this address come from two banks of 32 bits: DTCM and the data cache.
    [[nodiscard]] bool has_banks(std::uint32_t address) const;
    [[nodiscard]] bool in_dtcm(std::uint32_t address) const { return place_of(address) == Place::dtcm; }

    /// A read of the flash, in core cycles, the bus included. Exposed for the README's tables.
    [[nodiscard]] std::int64_t flash_wait_states() const { return wait_states_; }

private:
    /// Or as good as: where nothing waits, whatever the memory is called.
    [[nodiscard]] bool in_tcm(std::uint32_t address) const {
        return nothing_waits_ || place_of(address) <= Place::dtcm;
    }
    [[nodiscard]] Place place_of(std::uint32_t address) const {
        return ranges_.empty() ? (is_data(address) ? data_place_ : code_place_) : place_among_ranges(address);
    }
    [[nodiscard]] Place place_among_ranges(std::uint32_t address) const;
    [[nodiscard]] Delay load_from_afar(std::uint32_t address);
    static bool is_data(std::uint32_t address) { return address >= 0x20000000U; }
    [[nodiscard]] Delay read_flash(std::uint32_t address, bool fetch);
    [[nodiscard]] std::int64_t sram_line() const;

    const Figures& figures_;
    Place code_place_;
    Place data_place_;
    std::vector<PlacedRange> ranges_;
    Cache instructions_;
    Cache data_;
    Cache accelerator_;
    std::int64_t wait_states_;
    bool nothing_waits_;                           // no wait state, and no bus between
    std::uint32_t open_fetch_line_ = 0xFFFFFFFFU;  // what the flash read last
    std::uint32_t open_data_line_ = 0xFFFFFFFFU;
    std::uint32_t prefetched_line_ = 0xFFFFFFFFU;
};

}  // namespace timing
