#include "bench/host/timed_rows.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace bench {

std::int64_t iterations_for(double ns, std::size_t taps) {
    constexpr double wanted_ns = 2e6;
    const double turns = std::ceil(wanted_ns / (std::max(ns, 0.1) * static_cast<double>(taps)));
    return static_cast<std::int64_t>(std::min(turns, 1e6)) * static_cast<std::int64_t>(taps);
}

void drop_iterations(Json& row, const char* key) {
    const auto field = row.find(key);
    if (field == row.end()) {
        return;
    }
    std::string name = field->get<std::string>();
    constexpr std::string_view mark = "/iterations:";
    if (const std::size_t begin = name.find(mark); begin != std::string::npos) {
        name.erase(begin, name.find_first_not_of("0123456789", begin + mark.size()) - begin);
        *field = name;
    }
}

}  // namespace bench
