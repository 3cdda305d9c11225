// The branch predictor: a table of targets with two-bit counters. Size and algorithm of the real one are not published.
#pragma once

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
    explicit Predictor(std::int64_t entries);
    /// What the predictor would have said; then it learns.
    /// \param next  address of the instruction that was executed next
    Prediction meet(const Decoded& branch, std::uint32_t address, std::uint32_t next);

private:
    struct Entry {
        std::uint32_t address = 1;  // odd: none
        std::uint32_t target = 0;
        int confidence = 0;  // 0 to 3; from 2 on: taken
    };
    static constexpr std::size_t ways = 4;
    std::vector<Entry> entries_;  // of each set together, the most recently used first; a power of two of sets
    std::size_t last_set_;
};

}  // namespace timing
