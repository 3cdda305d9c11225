// Error against memory length, as SVG and PNG, by gnuplot.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/rows/groups.hpp"
#include "bench/sweep/truncation_bound.hpp"

namespace bench {

/// Writes `stem`.svg and `stem`.png: for each order the total error and the rounding error of each kernel, the
/// truncation error and its bound, over the length. At most 24 orders and 200 kernels, the first ones. \param bounds
/// may be empty: then none is drawn \throws glsum::Failure (missing) without gnuplot, (bad input) when a file cannot be
/// written.
void plot_error(const std::vector<Group>& groups, const WorstBounds& bounds, const std::filesystem::path& stem);

}  // namespace bench
