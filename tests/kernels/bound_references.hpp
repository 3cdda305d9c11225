// What the kernels' error bounds are tested against. Exact sums in 50 digits take a second, and each of 142 tests is a
// process of its own: they are made once, with the tests' build, and read from files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "reference/dropped.hpp"
#include "reference/sums.hpp"

namespace test {

struct BoundReference {
    double order;
    std::size_t taps;
    std::vector<double> record;
    reference::Sums exact;
};

/// Weights that no order has: those of higher order, as a kernel gets them and in 50 digits.
struct HigherOrderReference {
    unsigned steps;
    double order;
    std::size_t taps;
    std::vector<double> named;
    std::vector<double> record;
    reference::Sums exact;
};

/// Ten orders, seven signals and five lengths over 400 samples. \throws std::runtime_error for a file that is not what
/// `write_bound_references` wrote
[[nodiscard]] std::vector<BoundReference> read_bound_references(const std::filesystem::path& folder,
                                                                reference::Dropped dropped);

/// Six orders, three formulae, three signals and three lengths over 300 samples; of increments, or not. \throws the same
[[nodiscard]] std::vector<HigherOrderReference> read_higher_order_references(const std::filesystem::path& folder,
                                                                             bool increments);

/// Computes all of them, and writes their exact sums.
void write_bound_references(const std::filesystem::path& folder);

}  // namespace test
