// What a study found: a measurement of its own, apart from the sweep.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/gnuplot.hpp"
#include "bench/rows/row.hpp"

namespace bench {

struct Study {
    std::string text;  ///< its tables, for people
    Json context;      ///< of its result file
    std::vector<Json> rows;
    std::size_t wrong = 0;  ///< rows whose answer is; they are marked
    std::optional<base::Picture> picture = {};
};

}  // namespace bench
