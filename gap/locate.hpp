// Where a gap lies: shares of its square that add up to one.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

/// A part of an axis and its share of the squared gap.
struct Share {
    double from;
    double to;
    double share;
    std::string what;  ///< of time: the event that the part follows
};

struct Where {
    std::vector<Share> time;       ///< s
    std::vector<Share> frequency;  ///< Hz
    std::vector<Share> input_level;
    std::vector<Share> output_level;
    double rising = 0.0;
    double falling = 0.0;
    double still = 0.0;
};

/// \param residuals  measured - simulated of each record, one for each sample
/// Every list's shares sum to 1, direction's three too; where there is no gap at all each part has the share of its
/// samples.
[[nodiscard]] Where locate(const std::vector<Record>& records, const std::vector<std::vector<double>>& residuals);

}  // namespace gap
