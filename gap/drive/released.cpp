#include "gap/drive/released.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gap {

double level_at_rest(const Record& record) {
    const std::vector<double>& z = record.output;
    const std::size_t tenth = std::max<std::size_t>(1, z.size() / 10);
    return std::accumulate(z.end() - static_cast<std::ptrdiff_t>(tenth), z.end(), 0.0) / static_cast<double>(tenth);
}

std::size_t samples_held(const Record& record) {
    const std::vector<double>& z = record.output;
    const double rest = level_at_rest(record);
    const bool above = z.front() > rest;
    std::size_t farthest = 0;
    std::size_t i = 0;
    for (; i < z.size() && (z[i] > rest) == above; ++i) {
        farthest = std::fabs(z[i] - rest) > std::fabs(z[farthest] - rest) ? i : farthest;
    }
    return i < z.size() && farthest < z.size() / 4 ? farthest : 0;
}

std::vector<std::vector<char>> from_release(std::vector<std::vector<char>> counts, const std::vector<Record>& records) {
    for (std::size_t r = 0; r < records.size(); ++r) {
        std::fill_n(counts[r].begin(), samples_held(records[r]), '\0');
    }
    return counts;
}

void say_releases(const std::vector<Record>& records, std::vector<std::string>& notes) {
    for (const Record& record : records) {
        if (const std::size_t held = samples_held(record); held > 0) {
            notes.push_back(fmt::format("{}: counts from {:.4g} s on, its first turn: before that it may be held",
                                        record.name, record.time_s[held] - record.time_s.front()));
        }
    }
}

}  // namespace gap
