// Where a gap lies: shares of it that add up to one.
#pragma once

#include <string>
#include <vector>

namespace gap {

/// A part of an axis and its share of the squared gap.
struct Share {
    double from;
    double to;
    double share;
    std::string what;  ///< of time: the event that the part follows
};

/// Of a record's gap.
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

/// A part of measured rows and its share of the gap.
struct NamedShare {
    std::string name;
    double share;
};

/// Of measured cycles; each list by size.
struct WhereInRows {
    std::vector<NamedShare> kernels, placements;
    std::vector<NamedShare> lines;  ///< along a kernel's length: `slope` and `constant`
};

}  // namespace gap
