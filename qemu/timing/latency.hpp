// From which result to which use it takes how many cycles: one table, filled from the rows of a core file.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "qemu/timing/core_file.hpp"
#include "qemu/timing/decoded.hpp"
#include "qemu/timing/effects.hpp"

namespace timing {

/// What a register's value comes from.
enum class Producer : std::uint8_t {
    nothing,  ///< there for long
    early,
    late,
    younger_add,
    bitfield,
    reversed,
    saturated,
    base,
    load_word,
    load_narrow,
    multiply,
    divide,
    flags,
    to_core,
    compare,
    fp_add,
    fp_mul,
    fma,
    mla,
    fp_load,
    fp_convert,
    fp_move,
    core_to_fp,
    fp_immediate,
    add64,
    mul64,
    mac64,
    count,
};

/// In which place a register is used, of the core or of the FPU.
enum class Consumer : std::uint8_t {
    address,
    index,
    shifted,
    operand,
    operand_beside_shifted,  ///< of an instruction whose other operand is read early
    multiplicand,
    accumulator,
    store_data,
    condition,
    fma_accumulator,
    mla_accumulator,
    count,
};

[[nodiscard]] Effect effect_of(Producer producer);

class Latencies {
public:
    explicit Latencies(const Figures& figures);
    /// The consumer may issue so many cycles after the producer; 0: with it.
    [[nodiscard]] std::int64_t between(Producer producer, Consumer consumer) const {
        return table_[static_cast<std::size_t>(producer)][static_cast<std::size_t>(consumer)];
    }

    /// Of all its consumers.
    [[nodiscard]] std::int64_t longest(Producer producer) const {
        const auto& row = table_[static_cast<std::size_t>(producer)];
        return *std::max_element(row.begin(), row.end());
    }

private:
    static constexpr auto producers = static_cast<std::size_t>(Producer::count);
    static constexpr auto consumers = static_cast<std::size_t>(Consumer::count);
    std::array<std::array<std::int64_t, consumers>, producers> table_{};
};

[[nodiscard]] Consumer consumer_of(const Decoded& reader, Role role);

}  // namespace timing
