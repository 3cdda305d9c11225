// Where a record's gap lies.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gap/drive/record.hpp"
#include "gap/verdict/where.hpp"

namespace gap {

/// \param residuals  measured - simulated of each record, one for each sample
/// \param counts  by record and sample: what is not to be counted is cut off where the rest is one stretch, and has no
/// part in the squares elsewhere. Empty: everything counts
/// Every list's shares sum to 1, direction's three too; where there is no gap at all each part has the share of its
/// samples.
[[nodiscard]] Where locate(std::vector<Record> records, std::vector<std::vector<double>> residuals,
                           const std::vector<std::vector<char>>& counts = {});

}  // namespace gap
