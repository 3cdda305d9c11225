// One offline page out of one or two result files.
#pragma once

#include <string>

#include "bench/rows/result_file.hpp"
#include "bench/sweep/truncation_bound.hpp"

namespace bench::report {

/// A result file, what the page calls it, and the bounds of its truncation.
struct Input {
    std::string name;
    Results results;
    TruncationBounds bounds;
};

/// The whole page: markup, style, D3, script and data; it loads nothing. What comes from the files stands in it as JSON
/// in which no character can end the element, and reaches the screen as text alone; a content security policy admits
/// no script but the page's own two.
/// \param other  null: nothing is overlaid
[[nodiscard]] std::string make_page(const Input& input, const Input* other);

}  // namespace bench::report
