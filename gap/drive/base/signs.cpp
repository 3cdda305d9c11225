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

std::vector<Record> with_signs(std::vector<Record> records) {
    for (Record& record : records) {
        double sign = 1.0;
        double driven = 0.0;  // the last sign of the input that is none of 0
        std::size_t from = 0;
        for (std::size_t i = 0; i <= record.size(); ++i) {
            const double now =
                i == record.size() || record.input[i] == 0.0 ? driven : std::copysign(1.0, record.input[i]);
            if (i < record.size() && now == driven) {
                continue;
            }
            // What lies before this change of the input: the sign of the last one, from where the readings are least
            // on.
            const auto begin = record.output.begin();
            const auto least =
                std::min_element(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(i));
            for (auto at = begin + static_cast<std::ptrdiff_t>(from); at != begin + static_cast<std::ptrdiff_t>(i);
                 ++at) {
                const bool turned = driven != 0.0 && at >= least;
                *at *= turned ? driven : sign;
            }
            sign = driven != 0.0 ? driven : now;
            driven = now;
            from = i;
        }
    }
    return records;
}

}  // namespace gap
