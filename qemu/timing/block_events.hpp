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

/// What an instruction's accesses bring to the core.
struct AccessEvent {
    std::uint64_t load_delay : 16 = 0;   ///< extra cycles of all its loads, 65535 for more
    std::uint64_t accesses : 6 = 0;      ///< really made
    std::uint64_t access_bytes : 4 = 0;  ///< of each
    std::uint64_t meets : 8 = 0;         ///< bit n: a load of the word that the last store but n wrote
    Effect load_effect : 4 = Effect::dcache_misses;
    bool odd_word : 1 = false;   ///< of the first access: its bank
    bool off_eight : 1 = false;  ///< the first address is no multiple of 8
    bool unaligned : 1 = false;
    bool has_banks : 1 = false;  ///< of the memory that the first access goes to
    bool in_dtcm : 1 = false;
};

/// What its fetch, and what it does to the flow, bring.
struct FlowEvent {
    std::uint16_t words : 3 = 0;  ///< of the fetch, taken up for this instruction
    Effect fetch_effect : 4 = Effect::icache_misses;
    Prediction prediction : 2 = Prediction::right;
    bool taken : 1 = false;  ///< what is executed next does not stand behind this
};

/// All that one execution of an instruction brings to the core, beside the instruction itself.
struct Event : AccessEvent, FlowEvent {
    std::array<std::uint16_t, 4> fetch_delays{};  ///< extra cycles of each word
    bool store_delayed = false;
    Effect store_effect = Effect::dcache_misses;
    std::array<std::uint16_t, 32> store_delays{};  ///< extra cycles of each store, if one has any

    [[nodiscard]] bool fetch_delayed() const { return std::bit_cast<std::uint64_t>(fetch_delays) != 0; }
};

/// Equal events have equal words, others others, provided that `packs`.
struct PackedEvent {
    static constexpr unsigned bits = 55;  ///< of `event`, the lowest
    std::uint64_t event;
    std::uint64_t fetch_delays;  ///< 0: none, and `event` says so
};
[[nodiscard]] inline bool packs(const Event& e) { return !e.store_delayed && e.words <= e.fetch_delays.size(); }
[[nodiscard]] inline PackedEvent packed(const Event& e) {
    const auto accesses = std::bit_cast<std::uint64_t>(static_cast<const AccessEvent&>(e));
    const auto flow = std::bit_cast<std::uint16_t>(static_cast<const FlowEvent&>(e));
    return {accesses | std::uint64_t{flow} << 44 | std::uint64_t{e.fetch_delayed()} << 54,
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
