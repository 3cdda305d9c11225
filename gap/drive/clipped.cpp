#include "gap/drive/clipped.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gap {
namespace {

// By sample: whether its reading is the record's highest, or the opposite of that.
std::vector<char> extremes_of(const Record& record) {
    const double high = *std::max_element(record.output.begin(), record.output.end());
    std::vector<char> extreme(record.size());
    for (std::size_t i = 0; i < extreme.size(); ++i) {
        extreme[i] = std::fabs(record.output[i]) == std::fabs(high) ? 1 : 0;
    }
    return extreme;
}

}  // namespace

bool ends_would_show(const Record& record) {
    // Of such readings ten in a row are equal once in a thousand.
    constexpr double most_repeat = 0.5;
    const std::vector<char> extreme = extremes_of(record);
    double elsewhere = 0.0;
    double repeated = 0.0;
    for (std::size_t i = 1; i < record.size(); ++i) {
        if (extreme[i] == 0) {
            elsewhere += 1.0;
            repeated += record.output[i] == record.output[i - 1] ? 1.0 : 0.0;
        }
    }
    return elsewhere > 0.0 && repeated < most_repeat * elsewhere;
}

std::vector<char> clipped_readings(const Record& record) {
    constexpr std::size_t fewest = 10;
    std::vector<char> clipped(record.size(), 0);
    if (!ends_would_show(record)) {
        return clipped;
    }
    const std::vector<char> extreme = extremes_of(record);
    for (std::size_t from = 0, to = 0; from < record.size(); from = to) {
        for (to = from + 1; to < record.size() && record.output[to] == record.output[from]; ++to) {
        }
        if (extreme[from] != 0 && to - from >= fewest) {
            std::fill(clipped.begin() + static_cast<std::ptrdiff_t>(from),
                      clipped.begin() + static_cast<std::ptrdiff_t>(to), 1);
        }
    }
    return clipped;
}

}  // namespace gap
