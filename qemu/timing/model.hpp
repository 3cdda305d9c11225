// The core: takes executed instructions one after the other and says in which half cycle each issues, and what it
// waited for.
//
// Time runs in half cycles: position 2 c is the older slot of cycle c, 2 c + 1 the younger. An instruction that nothing
// holds takes the position behind its predecessor's. Whatever holds it is asked in a fixed order (see model.cpp); each
// moves it on to where that alone would let it go, and the distance is that cause's loss. So the losses sum exactly to
// what the program takes above one half cycle an instruction, which is what the core `m7-ideal` takes.
#pragma once

#include <array>
#include <cstdint>

#include "qemu/timing/core_file.hpp"
#include "qemu/timing/decoded.hpp"
#include "qemu/timing/effects.hpp"
#include "qemu/timing/latency.hpp"
#include "qemu/timing/model_of.hpp"
#include "qemu/timing/pipeline_base.hpp"
#include "qemu/timing/prepared.hpp"
#include "qemu/timing/store_buffer.hpp"
#include "qemu/timing/stored_words.hpp"
#include "qemu/timing/surroundings.hpp"

namespace timing {

/// All that the core remembers of the instructions before. Cycles, but for the positions.
struct State {
    static constexpr std::int32_t never = -1000;

    struct Value {
        std::int32_t cycle = never;  // its producer's, or for what comes later in one instruction, that much later
        Producer producer = Producer::nothing;
        bool operator==(const Value&) const = default;
    };
    struct Hold {
        std::int32_t until = 0;  // position
        Effect effect = Effect::single_issue;
        bool operator==(const Hold&) const = default;
    };

    // The instruction in the older slot, if the younger is still open.
    const Decoded* older = nullptr;
    bool older_taken = false;
    bool older_accesses = false;
    bool older_odd_word = false;
    bool older_has_banks = false;
    bool mac64_before = false;

    std::int32_t position = -1;        // of the instruction at work; before that, of its predecessor
    std::array<Hold, 4> next_holds{};  // what the last instruction makes the next one wait for
    std::size_t next_hold_count = 0;

    // The FPU.
    std::int32_t last_mac = never;
    std::int32_t mac_before = never;  // the one before the last
    std::int32_t last_mla = never;
    std::int32_t last_fp_load = never;
    std::int32_t last_fp_store = never;
    std::int32_t last_move = never;
    std::int32_t fp_busy_until = 0;    // for arithmetic alone
    std::int32_t fp_blocks_until = 0;  // for everything, from the cycle behind its issue
    std::int32_t fp_blocks_from = 0;

    // Fetching.
    std::int32_t fetch_ready = -1;             // cycle in which the word at hand is there
    std::array<std::int32_t, 8> fetch_used{};  // cycles in which the last words were first used, the newest first

    std::array<std::int32_t, stores_watched> stored;          // cycles of the last stores, the newest first
    std::array<std::int32_t, 2> late_fp_store{never, never};  // by bank: cycle of an FP store not yet met
    StoreBuffer store_buffer;

    std::array<std::int32_t, 32> multiplicand_of_mac;  // cycle in which a MAC read each register
    std::array<Value, registers::count> values{};

    State();
    bool operator==(const State&) const = default;
};
/// Of what differs between states most.
[[nodiscard]] std::uint64_t hash_of(const State& state);

/// The core under one rule set.
class Pipeline : public PipelineBase<State> {
public:
    static constexpr Core core = Core::cortex_m7;

    /// \param longest_fetch  the most extra cycles that a word of a fetch will come with (`Memory::longest_fetch`)
    Pipeline(const Figures& figures, std::int64_t longest_fetch, Effects off);

    /// One executed instruction: moves `state` on, and adds to `losses`.
    void execute(const Prepared& instruction, const Event& event);

    /// Sets the clock back so that the state's position is 0 or 1, and forgets what can hold nothing any more: two
    /// states that become equal behave alike for ever. \return cycles that it was set back by
    std::int32_t settle();

private:
    void hold_next(Effect effect, std::int32_t until);

    void wait_for_bytes(const Event& event);
    void wait_for_operands(const Prepared& instruction);
    void wait_for_fpu(const Decoded& d);
    void wait_for_division();
    void wait_for_stores(const Decoded& d, const Event& event);
    void wait_for_a_slot(const Decoded& d, const Event& event);
    [[nodiscard]] bool banks_conflict(const Event& event) const;

    [[nodiscard]] Producer producer_of(const Prepared& instruction) const;
    void write_results(const Prepared& instruction);
    void occupy(const Decoded& d, const Event& event);
    void access_memory(const Decoded& d, const Event& event);
    void follow_branch(const Decoded& d, const Event& event);
    void note_fpu(const Decoded& d);

    Latencies latencies_;
    std::size_t fetch_queue_;        // words, 1 to 8
    std::int32_t fetch_memory_;      // cycles behind which the queue does not look back
    std::int32_t fp_memory_;         // cycles behind which no rule looks back at an FP instruction
    std::int64_t result_delay_ = 0;  // cycles that the loads of the instruction at work come late
};

using Model = ModelOf<Pipeline>;

}  // namespace timing
