#include "gap/drive/base/signs.hpp"

#include <algorithm>
#include <cmath>

namespace gap {

bool may_have_lost_signs(const std::vector<Record>& records) {
    double low = 0.0;
    double high = 0.0;
    bool above = false;
    bool below = false;
    for (const Record& record : records) {
        for (std::size_t i = 0; i < record.size(); ++i) {
            low = std::min(low, record.output[i]);
            high = std::max(high, record.output[i]);
            above = above || record.input[i] > 0.0;
            below = below || record.input[i] < 0.0;
        }
    }
    constexpr double noise_share = 0.05;
    return above && below && low > -noise_share * (high - low);
}

namespace {

// Where the values are least before they rise by so much again.
template <class At>
At first_turn(At begin, At end, double rise) {
    At least = begin;
    for (At at = begin; at != end && *at <= *least + rise; ++at) {
        least = *at < *least ? at : least;
    }
    return least;
}

}  // namespace

std::vector<Record> with_signs(std::vector<Record> records) {
    for (Record& record : records) {
        const double highest = *std::max_element(record.output.begin(), record.output.end());
        double sign = 1.0;
        double driven = 0.0;  // the last sign of the input that is none of 0
        std::size_t from = 0;
        for (std::size_t i = 0; i <= record.size(); ++i) {
            const double now =
                i == record.size() || record.input[i] == 0.0 ? driven : std::copysign(1.0, record.input[i]);
            if (i < record.size() && now == driven) {
                continue;
            }
            // What lies before this change of the input: the sign of the last one, from where the readings first turn.
            const auto begin = record.output.begin() + static_cast<std::ptrdiff_t>(from);
            const auto end = record.output.begin() + static_cast<std::ptrdiff_t>(i);
            const auto turn = first_turn(begin, end, 0.05 * highest);
            for (auto at = begin; at != end; ++at) {
                *at *= driven != 0.0 && at >= turn ? driven : sign;
            }
            sign = driven != 0.0 ? driven : now;
            driven = now;
            from = i;
        }
    }
    return records;
}

}  // namespace gap
