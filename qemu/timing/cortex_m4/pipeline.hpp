// The Cortex-M4: one instruction a cycle, in order, by the table that its maker published, and what others measured
// beside it. Says like the Cortex-M7's pipeline (model.hpp) in which half cycle each instruction issues and what it
// waited for: here each begins a cycle of its own, so that half a cycle each is lost to `single_issue`.
#pragma once

#include <array>
#include <cstdint>

#include "qemu/timing/block_events.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/effects.hpp"
#include "qemu/timing/pipeline_base.hpp"
#include "qemu/timing/prepared.hpp"

namespace timing::cortex_m4 {

/// All that the core remembers of the instructions before. Cycles, but for the position.
struct State {
    static constexpr std::size_t most_words = 8;  // of the prefetch buffer

    // From when on a register may be an address, and what for it waits until then.
    struct Value {
        std::int32_t address_from = 0;
        bool loaded = false;
        bool operator==(const Value&) const = default;
    };
    // What the instruction before makes the next one wait for.
    struct Hold {
        std::int32_t until = 0;  // cycle
        Effect effect = Effect::single_issue;
        bool operator==(const Hold&) const = default;
    };

    std::int32_t position = -1;  // half cycle of the last instruction
    bool narrow_before = false;
    std::array<Hold, 3> holds{};

    // The last access, if the instruction before made it and may let the next one issue earlier than others.
    enum class Access : std::uint8_t { none, load, store, indexed_store };
    Access last_access = Access::none;
    bool last_in_data = false;     // which block of memory
    std::int32_t access_ends = 0;  // for what does not pipeline
    std::int32_t store_done = 0;   // the store buffer's only entry
    Effect store_effect = Effect::store_buffer;

    std::array<Value, 16> values{};
    std::array<std::int32_t, 32> fp_from{};  // from when on an FP register may be a plain operand
    std::uint32_t fp_computed = 0;           // of which the next MAC may take as its addend earlier: bit set
    std::int32_t fpu_free = 0;

    std::int32_t fetched = 0;                      // from when on the last word may be used
    std::array<std::int32_t, most_words> freed{};  // when the last words were used up, the newest first

    bool operator==(const State&) const = default;
};
[[nodiscard]] std::uint64_t hash_of(const State& state);

/// The core under one rule set.
class Pipeline : public PipelineBase<State> {
public:
    static constexpr Core core = Core::cortex_m4;

    /// \param longest_fetch  the most extra cycles that a word of a fetch will come with (`Memory::longest_fetch`)
    Pipeline(const Figures& figures, std::int64_t longest_fetch, Effects off);

    /// One executed instruction: moves `state` on, and adds to `losses`.
    void execute(const Prepared& instruction, const Event& event);
    /// Sets the clock back, see the Cortex-M7's. \return cycles that it was set back by
    std::int32_t settle();

private:
    void wait_for_the_one_before(const Decoded& d, const Event& event);
    void wait_for_bytes(const Decoded& d, const Event& event);
    void wait_for_operands(const Decoded& d);
    void leave_behind(const Decoded& d, const Event& event);
    void access_memory(const Decoded& d, const Event& event);
    void write_results(const Decoded& d, std::int64_t takes, std::int64_t fpu_takes);
    void refill(const Decoded& d, std::int64_t taken);

    [[nodiscard]] std::int64_t cycles_of(const Decoded& d, const Event& event) const;

    std::size_t words_;            // of the prefetch buffer
    std::int32_t fetch_memory_;    // cycles behind which it does not look back
    std::int64_t load_delay_ = 0;  // of the instruction at work
};

}  // namespace timing::cortex_m4
