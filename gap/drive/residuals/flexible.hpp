// What is left of a gap by any cause at all: a model without physics, fitted to some blocks of the residuals and judged
// on the others. If it helps where nothing listed does, something unlisted is missing.
#pragma once

#include <span>
#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

/// A record's residuals and what they may depend on.
struct Remainder {
    const Record* record;
    std::vector<double> simulated;
    std::vector<double> residuals;
    std::vector<char> counts;  ///< whether a sample may be fitted and is judged
};

struct Flexible {
    double explained = 0.0;  ///< share of the squared residuals that is gone in blocks not fitted; at least 0
    bool certain = false;    ///< whether that is more than chance, by its spread from block to block
    std::vector<std::vector<double>> left;  ///< residuals without it, by record of `judge`
};

/// Ridge regression on `features_of`: each block of a record is foretold by those of the other folds.
/// \param judge  whose residuals are to be predicted; \param also  further records that are fitted
[[nodiscard]] Flexible explain(const std::vector<Remainder>& judge, const std::vector<Remainder>& also, double delay_s,
                               double time_constant_s);

}  // namespace gap
