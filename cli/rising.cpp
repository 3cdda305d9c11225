#include "cli/rising.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/failure.hpp"
#include "cli/name_value.hpp"

namespace cli {

std::vector<std::size_t> to_rising(const std::vector<std::string>& words, const Counted& counted) {
    std::vector<std::size_t> counts;
    for (const std::string& word : words) {
        const auto count = to_number<std::size_t>(word);
        if (!count || *count < counted.fewest || *count > counted.most) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("{}: expected {} to {} {}, found {}", counted.option, counted.fewest,
                                             counted.most, counted.what, word));
        }
        counts.push_back(*count);
    }
    std::sort(counts.begin(), counts.end());
    counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
    return counts;
}

}  // namespace cli
