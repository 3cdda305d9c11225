#include "gap/drive/ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gap/drive/clipped.hpp"

namespace gap {
namespace {

// Of second differences: their median size is 0.6745 times their deviation, whose square is six times the noise's.
double noise_of(const std::vector<double>& z) {
    std::vector<double> sizes;
    for (std::size_t i = 2; i < z.size(); ++i) {
        sizes.push_back(std::fabs(z[i] - 2.0 * z[i - 1] + z[i - 2]));
    }
    if (sizes.empty()) {
        return 0.0;
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle / 0.6745 / std::sqrt(6.0);
}

// Whether more input makes more output: of what both are off from their means.
bool follows(const Record& record) {
    double u = 0.0;
    double z = 0.0;
    const auto count = static_cast<double>(record.size());
    for (std::size_t i = 0; i < record.size(); ++i) {
        u += record.input[i] / count;
        z += record.output[i] / count;
    }
    double both = 0.0;
    for (std::size_t i = 0; i < record.size(); ++i) {
        both += (record.input[i] - u) * (record.output[i] - z);
    }
    return both >= 0.0;
}

}  // namespace

std::vector<char> readings_at_an_end(const Record& record) {
    constexpr double noises = 8.0;     // from the highest reading down
    constexpr double of_swing = 0.02;  // likewise, where the noise is less
    constexpr double most_of_swing = 0.1;
    constexpr double further = 0.05;        // of the input's range
    constexpr double longest_delay = 0.03;  // of the record
    std::vector<char> at_an_end(record.size(), 0);
    const auto [low, high] = std::minmax_element(record.output.begin(), record.output.end());
    const auto [least, most] = std::minmax_element(record.input.begin(), record.input.end());
    const double swing = *high - *low;
    const double near = std::max(noises * noise_of(record.output), of_swing * swing);
    if (!(near < most_of_swing * swing) || *most == *least) {
        return at_an_end;
    }
    const double delay_s = longest_delay * (record.time_s.back() - record.time_s.front());
    for (const bool up : {true, false}) {
        const double way = up == follows(record) ? 1.0 : -1.0;
        const auto stays = [&](std::size_t i) {
            return up ? record.output[i] > *high - near : record.output[i] < *low + near;
        };
        for (std::size_t from = 0, to = 0; from < record.size(); from = to) {
            to = from + 1;
            if (!stays(from)) {
                continue;
            }
            std::size_t beyond = record.size();
            for (; to < record.size() && stays(to); ++to) {
                if (beyond == record.size() &&
                    way * (record.input[to] - record.input[from]) >= further * (*most - *least)) {
                    beyond = to;
                }
            }
            if (beyond < to && record.time_s[to - 1] - record.time_s[beyond] > delay_s) {
                std::fill(at_an_end.begin() + static_cast<std::ptrdiff_t>(from),
                          at_an_end.begin() + static_cast<std::ptrdiff_t>(to), 1);
            }
        }
    }
    return at_an_end;
}

std::vector<std::vector<char>> without_ends(std::vector<std::vector<char>> counts, const std::vector<Record>& records) {
    constexpr std::ptrdiff_t fewest = 50;
    for (std::size_t r = 0; r < counts.size(); ++r) {
        const std::vector<char> clipped = clipped_readings(records[r]);
        const std::vector<char> at_an_end = readings_at_an_end(records[r]);
        std::vector<char> left = counts[r];
        for (std::size_t i = 0; i < left.size(); ++i) {
            left[i] = clipped[i] != 0 || at_an_end[i] != 0 ? 0 : left[i];
        }
        if (std::count(left.begin(), left.end(), 1) >= fewest) {
            counts[r] = std::move(left);
        }
    }
    return counts;
}

}  // namespace gap
