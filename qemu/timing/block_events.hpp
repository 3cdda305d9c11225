// What the instructions of a block met when it was last executed on one core, and that in short.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "qemu/timing/effects.hpp"
#include "qemu/timing/predictor.hpp"

namespace timing {

/// What an instruction's accesses bring to the core. No bit is padding: it is packed as a number.
struct AccessEvent {
    std::uint64_t load_delay : 16 = 0;   ///< extra cycles of all its loads, 65535 for more
    std::uint64_t accesses : 6 = 0;      ///< really made
    std::uint64_t access_bytes : 4 = 0;  ///< of each
    std::uint64_t meets : 8 = 0;         ///< bit n: a load of the word that the last store but n wrote
    std::uint64_t odd_word : 1 = 0;      ///< of the first access: its bank
    std::uint64_t off_eight : 1 = 0;     ///< the first address is no multiple of 8
    std::uint64_t unaligned : 1 = 0;
    std::uint64_t has_banks : 1 = 0;  ///< of the memory that the first access goes to
    std::uint64_t in_dtcm : 1 = 0;
    std::uint64_t unused : 25 = 0;
};

/// All that one execution of an instruction brings to the core, beside the instruction itself.
struct Event : AccessEvent {
    Prediction prediction = Prediction::right;
    bool taken = false;                           ///< what is executed next does not stand behind this
    bool second_half = false;                     ///< it begins in the middle of a word of 4 bytes
    std::uint8_t words = 0;                       ///< of the fetch, taken up for this instruction, at most 7
    std::array<std::uint16_t, 4> fetch_delays{};  ///< extra cycles of each word
    Effect fetch_effect = Effect::icache_misses;
    Effect load_effect = Effect::dcache_misses;
    bool store_delayed = false;
    Effect store_effect = Effect::dcache_misses;
    std::array<std::uint16_t, 32> store_delays{};  ///< extra cycles of each store, if one has any

    [[nodiscard]] bool fetch_delayed() const { return std::bit_cast<std::uint64_t>(fetch_delays) != 0; }
};

/// What the words below hold of stores that their memory delays: one delay, and which of the first eight it met.
struct DelayedStores {
    std::uint16_t delay = 0;
    std::uint8_t which = 0;
    bool whole = true;  ///< that is all
};
[[nodiscard]] inline DelayedStores delayed_stores(const Event& e) {
    DelayedStores found;
    for (std::size_t n = 0; n < e.store_delays.size(); ++n) {
        if (e.store_delays[n] != 0) {
            found.whole = found.whole && n < 8 && (found.delay == 0 || found.delay == e.store_delays[n]);
            found.delay = e.store_delays[n];
            found.which = static_cast<std::uint8_t>(found.which | (n < 8 ? 1U << n : 0U));
        }
    }
    return found;
}

/// Equal events of one instruction have equal words, others others, provided that `packs`.
struct PackedEvent {
    static constexpr unsigned bits = 54;  ///< of `event`, the lowest
    std::uint64_t event;
    std::uint64_t fetch_delays;  ///< 0: none, and `event` says so
};
[[nodiscard]] inline bool packs(const Event& e) {
    return e.words <= e.fetch_delays.size() && (!e.store_delayed || delayed_stores(e).whole);
}
[[nodiscard]] inline PackedEvent packed(const Event& e) {
    AccessEvent accesses = e;
    std::uint64_t effect = accesses.load_delay > 0 ? index(e.load_effect) : 0;
    if (e.store_delayed) {  // in the bits of what only a load has
        const DelayedStores stores = delayed_stores(e);
        accesses.load_delay = stores.delay;
        accesses.meets = stores.which;
        effect = index(e.store_effect);
    }
    const std::uint64_t fetch = e.fetch_delayed() ? 1 + index(e.fetch_effect) : 0;
    return {std::bit_cast<std::uint64_t>(accesses) | effect << 39 | fetch << 43 | std::uint64_t{e.second_half} << 47 |
                std::uint64_t{e.words} << 48 | std::uint64_t{e.taken} << 51 |
                static_cast<std::uint64_t>(e.prediction) << 52,
            std::bit_cast<std::uint64_t>(e.fetch_delays)};
}

struct BlockEvents {
    std::vector<Event> events;           ///< of each instruction
    std::vector<std::uint32_t> touched;  ///< those that made accesses this time, ascending
    std::uint32_t last_word = 0;         ///< of the fetch
    bool fetched_freely = false;         ///< this time nothing but the first word could differ from the time before
    bool known = false;                  ///< so much of the words at least

    /// The events in short: of one block, equal keys are equal events of all its instructions. Empty: there is none.
    [[nodiscard]] std::span<const std::uint64_t> key() const { return std::span(words_).first(count_); }
    void make_key();

private:
    std::vector<std::uint64_t> words_;
    std::size_t count_ = 0;
};

}  // namespace timing
