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
#include <span>

#include "qemu/stream.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/decoded.hpp"
#include "qemu/timing/effects.hpp"
#include "qemu/timing/latency.hpp"
#include "qemu/timing/memory.hpp"
#include "qemu/timing/predictor.hpp"
#include "qemu/timing/store_buffer.hpp"

namespace timing {

/// Half cycles lost to each effect.
using Losses = std::array<std::int64_t, effect_count>;

/// A decoded instruction with what does not change from one execution to the next.
struct Prepared {
    Decoded decoded;
    std::array<Consumer, 36> consumers{};
    explicit Prepared(const Decoded& d);
};

class Model {
public:
    Model(const Figures& figures, Placement placement, Effects off);
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    /// One executed instruction. \param next  address of the one that was executed after it
    /// \return the half cycle in which it issues
    std::int64_t execute(const Prepared& instruction, std::uint32_t address, std::span<const qemu::Access> accesses,
                         std::uint32_t next);

    /// Half cycle in which the last instruction issued.
    [[nodiscard]] std::int64_t position() const { return position_; }
    [[nodiscard]] const Losses& losses() const { return losses_; }

private:
    struct Value {
        std::int64_t cycle = -1000;  // its producer's, or for what comes later in one instruction, that much later
        Producer producer = Producer::nothing;
    };
    struct Hold {
        std::int64_t until = 0;  // half cycle
        Effect effect = Effect::single_issue;
    };

    void hold(Effect effect, std::int64_t until);
    void hold_next(Effect effect, std::int64_t until);
    void hold_cycle(Effect effect, std::int64_t cycle) { hold(effect, 2 * cycle); }

    void wait_for_bytes(const Decoded& d, std::uint32_t address);
    void wait_for_operands(const Prepared& instruction);
    void wait_for_fpu(const Decoded& d);
    void wait_for_division();
    void wait_for_stores(const Decoded& d, std::span<const qemu::Access> accesses);
    void wait_for_a_slot(const Decoded& d, std::span<const qemu::Access> accesses);
    [[nodiscard]] bool banks_conflict(std::span<const qemu::Access> accesses) const;

    [[nodiscard]] Producer producer_of(const Prepared& instruction) const;
    void write_results(const Prepared& instruction);
    void occupy(const Decoded& d, std::span<const qemu::Access> accesses);
    void access_memory(const Decoded& d, std::span<const qemu::Access> accesses);
    void follow_branch(const Decoded& d, std::uint32_t address, std::uint32_t next);
    void note_fpu(const Decoded& d);

    Figures figures_;
    Effects off_;
    Latencies latencies_;
    Memory memory_;
    Predictor predictor_;
    StoreBuffer store_buffer_;

    Losses losses_{};
    std::int64_t position_ = -1;  // of the instruction at work; before that, of its predecessor
    std::array<Value, registers::count> values_{};
    std::array<Hold, 8> next_holds_{};  // what the last instruction makes the next one wait for
    std::size_t next_hold_count_ = 0;
    std::int64_t result_delay_ = 0;  // cycles that the loads of this instruction come late

    // The instruction in the older slot, if the younger is still open.
    const Decoded* older_ = nullptr;
    bool older_taken_ = false;
    bool older_has_access_ = false;
    qemu::Access older_access_{};

    // The FPU.
    std::int64_t last_mac_ = -1000;
    std::int64_t mac_before_ = -1000;  // the one before the last
    std::int64_t last_mla_ = -1000;
    std::int64_t last_fp_load_ = -1000;
    std::int64_t last_move_ = -1000;
    std::int64_t fp_busy_until_ = 0;      // for arithmetic alone
    std::int64_t fp_blocks_until_ = 0;    // for everything, from the cycle behind its issue
    std::int64_t fp_blocks_from_ = 0;
    bool mac64_before_ = false;
    std::array<std::int64_t, 32> multiplicand_of_mac_{};  // cycle in which a MAC read each register

    // Fetching.
    std::uint32_t fetched_ = 0xFFFFFFFFU;  // number of the word at hand
    std::int64_t fetch_ready_ = -1;        // cycle in which it is there
    std::array<std::int64_t, 8> fetch_used_{};  // cycles in which the last words were first used
    std::size_t fetch_count_ = 0;

    // Stores that a load may meet.
    struct Stored {
        std::uint32_t word = 0xFFFFFFFFU;
        std::int64_t cycle = -1000;
    };
    std::array<Stored, 8> stored_{};
    std::size_t stored_count_ = 0;
    std::array<std::int64_t, 2> late_fp_store_{-1000, -1000};  // by bank: cycle of an FP store not yet met
};

}  // namespace timing
