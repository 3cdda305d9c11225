// What records say of themselves, without any model.
#pragma once

#include <string>
#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

struct Audit {
    double quantum = 0.0;     ///< readings are multiples of it; 0: of none that shows
    double held_share = 0.0;  ///< of readings that repeat the one before while the output moves
    double noise = 0.0;       ///< standard deviation of what differs from sample to sample; white noise's, at least
    bool may_clip = true;     ///< readings end at a limit, or would not show it
    std::size_t levels = 0;   ///< different levels of the input, to a fiftieth of the largest: at most 100
    std::vector<std::string> notes;
};

[[nodiscard]] Audit audit(const std::vector<Record>& records);

}  // namespace gap
