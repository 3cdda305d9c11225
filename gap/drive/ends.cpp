#include "gap/drive/ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "gap/drive/clipped.hpp"
#include "gap/drive/moments.hpp"
#include "gap/drive/white_noise.hpp"

namespace gap {
namespace {

double noise_of(const std::vector<double>& z) {
    std::vector<double> sizes;
    for (std::size_t i = 2; i < z.size(); ++i) {
        sizes.push_back(std::fabs(z[i] - 2.0 * z[i - 1] + z[i - 2]));
    }
    return noise_by_differences(std::move(sizes), 2);
}

// Whether more input makes more output.
bool follows(const Record& record) { return moments_of(record.input, record.output).xy >= 0.0; }

// How far from its highest or lowest reading a record stays there; none: noise hides it.
std::optional<double> nearness_to_an_end(const Record& record, double swing) {
    constexpr double noises = 8.0;
    constexpr double of_swing = 0.02;
    constexpr double most_of_swing = 0.1;
    const double near = std::max(noises * noise_of(record.output), of_swing * swing);
    return near < most_of_swing * swing ? std::optional(near) : std::nullopt;
}

// Marks the stretches for which `stays(sample)` while the input goes further, upwards or (way: -1) downwards.
template <typename Stays>
void mark_held(const Record& record, double way, double input_range, const Stays& stays, std::vector<char>& held) {
    constexpr double further = 0.05;        // of the input's range
    constexpr double longest_delay = 0.03;  // of the record
    const double delay_s = longest_delay * (record.time_s.back() - record.time_s.front());
    for (std::size_t from = 0, to = 0; from < record.size(); from = to) {
        to = from + 1;
        if (!stays(from)) {
            continue;
        }
        std::size_t beyond = record.size();
        for (; to < record.size() && stays(to); ++to) {
            if (beyond == record.size() && way * (record.input[to] - record.input[from]) >= further * input_range) {
                beyond = to;
            }
        }
        if (beyond < to && record.time_s[to - 1] - record.time_s[beyond] > delay_s) {
            std::fill(held.begin() + static_cast<std::ptrdiff_t>(from), held.begin() + static_cast<std::ptrdiff_t>(to),
                      1);
        }
    }
}

}  // namespace

std::vector<char> readings_at_an_end(const Record& record) {
    std::vector<char> held(record.size(), 0);
    const auto read = std::ranges::minmax(record.output);
    const auto put_in = std::ranges::minmax(record.input);
    const std::optional<double> near = nearness_to_an_end(record, read.max - read.min);
    if (near && put_in.max > put_in.min) {
        const double range = put_in.max - put_in.min;
        const double up = follows(record) ? 1.0 : -1.0;
        mark_held(
            record, up, range, [&](std::size_t i) { return record.output[i] > read.max - *near; }, held);
        mark_held(
            record, -up, range, [&](std::size_t i) { return record.output[i] < read.min + *near; }, held);
    }
    return held;
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
