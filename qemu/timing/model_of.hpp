// A core with its surroundings, each instruction computed as it comes. `Replay` (replay.hpp) gives the same, faster.
#pragma once

#include <cstdint>
#include <span>

#include "qemu/stream/stream.hpp"
#include "qemu/timing/prepared.hpp"
#include "qemu/timing/surroundings.hpp"

namespace timing {

/// For short programs: its positions end after 10^9 cycles.
template <class Pipeline>
class ModelOf {
public:
    ModelOf(const Figures& figures, Placement placement, Effects off)
        : surroundings_(figures, placement, Pipeline::core),
          pipeline_(figures, surroundings_.memory().longest_fetch(), off) {}

    /// One executed instruction. \param next  address of the one that was executed after it
    /// \return the half cycle in which it issues
    std::int64_t execute(const Prepared& instruction, std::uint32_t address, std::span<const qemu::Access> accesses,
                         std::uint32_t next) {
        pipeline_.execute(instruction, surroundings_.meet(instruction.decoded, address, accesses, next));
        return pipeline_.state.position;
    }
    [[nodiscard]] const Losses& losses() const { return pipeline_.losses; }

private:
    Surroundings surroundings_;
    Pipeline pipeline_;
};

}  // namespace timing
