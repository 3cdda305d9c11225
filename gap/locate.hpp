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
    /// s: what follows each move of the input by a fiftieth of its span or more between two rests, in pieces of at most
    /// a fifth of the record; tenths of a record whose input rests or moves all the time. Of every record in turn.
    std::vector<Share> time;
    /// Hz: what is constant, then about half-decades from one period in the longest record to half the highest rate.
    std::vector<Share> frequency;
    std::vector<Share> input_level;   ///< each level where there are at most 12, else fifths of the span
    std::vector<Share> output_level;  ///< likewise
    double rising = 0.0;
    double falling = 0.0;
    double still = 0.0;
};

/// \param residuals  measured - simulated of each record, one for each sample
/// \param counts  by record and sample: what is not to be counted is cut off where the rest is one stretch, and has no
/// part in the squares elsewhere. Empty: everything counts
/// Every list's shares sum to 1, direction's three too; where there is no gap at all each part has the share of its
/// samples.
[[nodiscard]] Where locate(std::vector<Record> records, std::vector<std::vector<double>> residuals,
                           const std::vector<std::vector<char>>& counts = {});

}  // namespace gap
