// How noisy readings are, by how neighbours differ.
#pragma once

#include <cstddef>
#include <vector>

namespace gap {

/// The deviation of white noise whose differences of an order have such sizes, by their median, which jumps leave
/// alone. Of normal noise it is 0.6745 times their deviation, whose square is binomial(2 order, order) times the
/// noise's. \return 0 of no differences
[[nodiscard]] double noise_by_differences(std::vector<double> sizes, std::size_t order);

}  // namespace gap
