// The branch predictor: a table of targets with two-bit counters, and a stack of return addresses. Size and algorithm
// of the real one are not published.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "qemu/timing/decoded.hpp"

namespace timing {

enum class Prediction : std::uint8_t {
    right,
    right_without_entry,  ///< taken, as the decoder guessed, but the target came from the decoder
    wrong,
};

class Predictor {
public:
    /// \param targets  branches that the table holds
    /// \param returns  calls under way that the stack holds; what it does not hold is guessed as any indirect branch is
    /// \param history  directions of conditional branches by 4096 two-bit counters, chosen by the branch's address and
    /// the
    ///                 last eight directions, not by the counter beside the target
    Predictor(std::int64_t targets, std::int64_t returns, bool history = false);
    /// What the predictor would have said; then it learns.
    /// \param next  address of the instruction that was executed next
    Prediction meet(const Decoded& branch, std::uint32_t address, std::uint32_t next);

private:
    struct Entry {
        std::uint32_t address = 1;  // odd: none
        std::uint32_t target = 0;
        int confidence = 0;  // 0 to 3; from 2 on: taken
    };
    [[nodiscard]] int& counter_of(std::uint32_t address, Entry& entry);
    Prediction meet_in_table(const Decoded& branch, std::uint32_t address, std::uint32_t next);

    static constexpr std::size_t ways = 4;
    std::vector<Entry> entries_;  // of each set together, the most recently used first; a power of two of sets
    std::size_t last_set_;
    std::vector<std::uint32_t> returns_;  // a ring
    std::size_t newest_ = 0;              // of it
    std::size_t held_ = 0;
    std::vector<int> counters_;  // by history; empty without
    std::uint32_t past_ = 0;     // directions, the last in bit 0
};

}  // namespace timing
