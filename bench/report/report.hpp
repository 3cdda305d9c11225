// Everything that a report is: the page, the pictures and the tables beside it.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/report/page.hpp"

namespace bench::report {

/// Writes `html` and beside it, under its stem: .csv (every row), .svg and .png (error against memory length).
/// \return the files, the page first
/// \throws glsum::Failure (bad input) when a file cannot be written, (missing) without gnuplot.
std::vector<std::filesystem::path> write_report(const Input& input, const Input* other,
                                                const std::filesystem::path& html, unsigned jobs);

}  // namespace bench::report
