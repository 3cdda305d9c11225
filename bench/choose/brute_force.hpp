// Does the search choose what a plain loop over every kernel and every length would?
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "bench/choose/costs.hpp"
#include "bench/choose/question.hpp"

namespace choose {

struct Agreement {
    std::size_t budgets = 0;
    std::size_t same = 0;        ///< the same kernel and length, or nothing from both
    std::size_t nothing = 0;     ///< of those: nothing fits
    std::size_t same_miss = 0;   ///< of these: the search's nearest miss is as near as any
    std::size_t candidates = 0;  ///< kernels times lengths, all measured
    std::string differences;     ///< a line for each budget that differs
};

/// Measures every kernel of the question at every length of its record, error and cost; then draws budgets (signals,
/// error, cost and bytes) and asks both: the search, with nothing but the sources, and the loop, with the whole table.
[[nodiscard]] Agreement check_against_brute_force(const Question& question, CostSource& costs, std::size_t budgets,
                                                  std::uint64_t seed);

/// The same on the emulated board, in modelled cycles or instructions as the question asks.
[[nodiscard]] Agreement check_against_brute_force(const Question& question, const qemu::Board& board,
                                                  std::size_t budgets, std::uint64_t seed);

}  // namespace choose
