// Everything that a report is: the page, the pictures and the tables beside it.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/report/page.hpp"

namespace bench::report {

/// Writes `html` and beside it, under its stem: .csv (every row), -curves.csv (every kernel, order and length with its
/// costs and fronts), .svg and .png (error against memory length), -cost.svg and -cost.png (error against each cost),
/// -fronts.svg and -fronts.png (the front of the classic windows beside that of all kernels), all of `input`, and with
/// a second file -difference.csv (both files row by row, the largest ratio first). A run without accuracy has no
/// pictures, one without costs no fronts.
/// \return the files, the page first
/// \throws glsum::Failure (bad input) when a file cannot be written, (missing) without gnuplot.
std::vector<std::filesystem::path> write_report(const Input& input, const Input* other,
                                                const std::filesystem::path& html);

}  // namespace bench::report
