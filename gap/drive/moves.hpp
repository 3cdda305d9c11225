// Where the held input moves at once.
#pragma once

#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

/// A step of the held input.
struct Move {
    double at_s;  ///< from the record's first stamp
    double from;
    double to;
};

/// The steps of a record's input by more than `least`, in order of time.
/// \param before  the input before the record: what it begins with may be a step, too
[[nodiscard]] std::vector<Move> moves_of(const Record& record, double before, double least);

}  // namespace gap
