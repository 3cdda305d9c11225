// Error against memory length, as SVG and PNG, by gnuplot.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/results.hpp"

namespace bench {

/// Writes `stem`.svg and `stem`.png: for each order the total error and the rounding error of each kernel, and the
/// truncation error, over the length.
/// \throws glsum::Failure (missing) without gnuplot, (bad input) when a file cannot be written.
void plot_error(const std::vector<Group>& groups, const std::filesystem::path& stem);

}  // namespace bench
