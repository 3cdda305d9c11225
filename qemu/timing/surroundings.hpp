// What lies around the core and knows no time: caches, the flash's buffers, the branch predictor, which word was stored
// last. Told each executed instruction, it says what the core meets there. One for a core file, whatever its rule sets.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "qemu/stream.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/decoded.hpp"
#include "qemu/timing/memory.hpp"
#include "qemu/timing/predictor.hpp"

namespace timing {

/// Stores that a load may meet, the newest first.
inline constexpr std::size_t stores_watched = 8;

/// All that one execution of an instruction brings to the core, beside the instruction itself.
struct Event {
    std::uint8_t accesses = 0;      ///< really made
    std::uint8_t access_bytes = 0;  ///< of each
    bool odd_word = false;          ///< of the first access: its bank
    bool off_eight = false;         ///< the first address is no multiple of 8
    bool unaligned = false;
    bool has_banks = false;  ///< of the memory that the first access goes to
    bool in_dtcm = false;
    std::uint8_t meets = 0;  ///< bit n: a load of the word that the last store but n wrote
    bool taken = false;      ///< what is executed next does not stand behind this
    Prediction prediction = Prediction::right;
    std::uint8_t words = 0;  ///< of the fetch, taken up for this instruction
    Effect fetch_effect = Effect::icache_misses;
    Effect load_effect = Effect::dcache_misses;
    Effect store_effect = Effect::dcache_misses;
    std::array<std::uint16_t, 4> fetch_delays{};  ///< extra cycles of each of them
    std::uint32_t load_delay = 0;                 ///< extra cycles of all loads
    bool store_delayed = false;
    std::array<std::uint16_t, 32> store_delays{};  ///< extra cycles of each store, if one has any
};

class Surroundings {
public:
    Surroundings(const Figures& figures, Placement placement);
    Surroundings(const Surroundings&) = delete;
    Surroundings& operator=(const Surroundings&) = delete;
    /// \param next  address of the instruction that is executed after it
    /// \return valid up to the next call
    const Event& meet(const Decoded& d, std::uint32_t address, std::span<const qemu::Access> accesses,
                      std::uint32_t next);

private:
    void fetch(const Decoded& d, std::uint32_t address);
    void load(std::span<const qemu::Access> accesses);
    void store(std::span<const qemu::Access> accesses);

    const Figures figures_;  // memory_ refers to it
    unsigned fetch_shift_;
    Memory memory_;
    Predictor predictor_;
    std::uint32_t fetched_ = 0xFFFFFFFFU;  // number of the word at hand
    std::array<std::uint32_t, stores_watched> stored_words_;
    Event event_;
};

}  // namespace timing
