// Instructions for cores that have no rules but those a test asks for. The Cortex-M7 without any: every two
// instructions pair, every result is there at once.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <utility>
#include <vector>

#include "qemu/timing/model.hpp"

namespace bare {

using timing::Branch;
using timing::Decoded;
using timing::Effect;
using timing::Effects;
using timing::Event;
using timing::Figures;
using timing::Kind;
using timing::Prediction;
using timing::Role;
using timing::Source;

inline constexpr unsigned s0 = timing::registers::s0;
inline constexpr unsigned nzcv = timing::registers::flags;

inline Figures no_rules() {
    Figures f;
    for (std::int64_t* allowed : {&f.issue_two_shifted_operands_pair,
                                  &f.issue_bitfield_in_younger_slot,
                                  &f.issue_two_multiplies_pair,
                                  &f.issue_multiply_pairs_with_store,
                                  &f.issue_two_loads_pair,
                                  &f.issue_two_stores_pair,
                                  &f.issue_load_pairs_with_store,
                                  &f.issue_multiple_pairs,
                                  &f.issue_if_then_pairs,
                                  &f.issue_two_branches_pair,
                                  &f.issue_untaken_branch_pairs,
                                  &f.issue_taken_branch_pairs_with_target,
                                  &f.issue_divide_pairs,
                                  &f.issue_system_pairs,
                                  &f.fp_two_arithmetic_pair,
                                  &f.fp_both_ports_pair,
                                  &f.fp_two_moves_pair,
                                  &f.fp_mac_pairs_with_fp_transfer,
                                  &f.fp_first_mac_pairs_with_fp_transfer,
                                  &f.result_add_in_younger_slot_early}) {
        *allowed = 1;
    }
    f.fetch_queue = 4;
    f.store_entries = 16;
    return f;
}

using Reads = std::vector<std::pair<Role, unsigned>>;

inline Decoded work(Kind kind, const std::vector<unsigned>& writes = {}, const Reads& reads = {}) {
    Decoded d;
    d.kind = kind;
    d.is_fp = kind >= Kind::fp_add;
    for (const auto& [role, reg] : reads) {
        d.read(role, reg);
    }
    for (const unsigned reg : writes) {
        d.write(reg);
    }
    return d;
}

inline Decoded transfer(Kind kind, const std::vector<unsigned>& moved, bool is_fp = false, std::uint8_t bytes = 4) {
    Decoded d;
    d.kind = kind;
    d.is_fp = is_fp;
    d.access_bytes = bytes;
    d.registers = static_cast<std::uint8_t>(moved.size());
    for (const unsigned reg : moved) {
        d.is_load() ? d.write(reg, Source::loaded) : d.read(Role::store_data, reg);
    }
    return d;
}

inline Decoded mac(unsigned sum, bool fused = true, bool is_double = false) {
    Decoded d = work(Kind::fp_mac, {sum}, {{Role::accumulator, sum}, {Role::multiplicand, s0 + 30}});
    d.fused = fused;
    d.is_double = is_double;
    return d;
}

inline Event accessing(unsigned accesses = 1) {
    Event event;
    event.accesses = accesses & 63U;
    event.access_bytes = 4;
    return event;
}

struct Step {
    Decoded decoded;
    Event event = {};
};

class Core {
public:
    explicit Core(const Figures& figures, const Effects& off = {}) : pipeline_(figures, 40, off) {}
    std::int32_t issue(const Decoded& d, const Event& event = {}) {
        pipeline_.execute(sites_.emplace_back(d), event);
        return pipeline_.state.position;
    }
    void idle(int instructions) {
        for (int n = 0; n < instructions; ++n) {
            (void)issue(work(Kind::hint));
        }
    }
    [[nodiscard]] std::int64_t lost(Effect effect) const { return pipeline_.losses[timing::index(effect)]; }

private:
    std::deque<timing::Prepared> sites_;  // the pipeline looks back at the last one
    timing::Pipeline pipeline_;
};

// Where the last of these issues, and that all it lost is this effect's.
inline std::int32_t last_of(const Figures& figures, const std::vector<Step>& steps, Effect effect,
                            const Effects& off = Effects()) {
    Core core(figures, off);
    std::int32_t at = -1;
    for (const Step& step : steps) {
        at = core.issue(step.decoded, step.event);
    }
    EXPECT_EQ(core.lost(effect), at - static_cast<std::int32_t>(steps.size()) + 1);
    return at;
}

}  // namespace bare
