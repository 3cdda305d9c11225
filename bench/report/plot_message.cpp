#include "bench/report/plot_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "bench/rows/key.hpp"

namespace bench {
namespace {

using LeastByOrder = std::map<std::string, double>;

void keep_least(LeastByOrder& least, const std::string& order, std::optional<double> value) {
    if (value) {
        double& held = least.try_emplace(order, *value).first->second;
        held = std::min(held, *value);
    }
}

// "least to most" of the orders
std::string range_text(const LeastByOrder& least) {
    const auto [smallest, largest] =
        std::ranges::minmax_element(least, {}, [](const auto& of_order) { return of_order.second; });
    return fmt::format("{:.2g} to {:.2g}", smallest->second, largest->second);
}

}  // namespace

std::string plot_message(const std::vector<Group>& groups) {
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0.0;
    for (const Group& group : groups) {
        if (const auto taps = taps_number(group.taps); taps && is_window(group.taps)) {
            shortest = std::min(shortest, *taps);
            longest = std::max(longest, *taps);
        }
    }
    LeastByOrder forgotten;
    LeastByOrder left;
    double most_terms = 0.0;
    for (const Group& group : groups) {
        const auto terms = taps_number(group.taps);
        if (!terms) {
            continue;
        }
        for (const Entry& entry : group.entries) {
            if (is_window(group.taps) && *terms == longest) {
                keep_least(forgotten, group.order, entry.truncation_error_max);
            } else if (!is_window(group.taps) && *terms < shortest && entry.fault.empty() && entry.error_max) {
                keep_least(left, group.order, entry.error_max);
                most_terms = std::max(most_terms, *terms);
            }
        }
    }
    return forgotten.empty() || left.empty()
               ? ""
               : fmt::format(
                     "The best window of {} taps forgets {} of the largest sum, by the order; the best of at most {} "
                     "taps and modes errs by {}\\n",
                     longest, range_text(forgotten), most_terms, range_text(left));
}

}  // namespace bench
