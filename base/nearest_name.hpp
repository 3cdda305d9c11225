// What was probably meant by a name that there is not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <ranges>
#include <string>
#include <vector>

namespace base {

/// How many letters are to be changed, inserted or dropped, or neighbours exchanged; what is exchanged stays as it is:
/// three from "ca" to "abc".
inline std::size_t letters_between(const std::string& from, const std::string& to) {
    std::vector<std::vector<std::size_t>> steps(from.size() + 1, std::vector<std::size_t>(to.size() + 1));
    for (std::size_t i = 0; i <= from.size(); ++i) {
        for (std::size_t j = 0; j <= to.size(); ++j) {
            if (i == 0 || j == 0) {
                steps[i][j] = i + j;
                continue;
            }
            const std::size_t change = from[i - 1] == to[j - 1] ? 0 : 1;
            steps[i][j] = std::min({steps[i - 1][j] + 1, steps[i][j - 1] + 1, steps[i - 1][j - 1] + change});
            if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1]) {
                steps[i][j] = std::min(steps[i][j], steps[i - 2][j - 2] + 1);
            }
        }
    }
    return steps[from.size()][to.size()];
}

/// Of `names`, not empty, the one at the least distance; the first of equals. \param name_in  where each has its name
template <std::ranges::input_range Names, class NameIn = std::identity>
[[nodiscard]] std::string nearest_name(const std::string& word, const Names& names, NameIn name_in = {}) {
    return std::string(std::invoke(name_in, *std::ranges::min_element(names, {}, [&](const auto& one) {
                                       return letters_between(word, std::string(std::invoke(name_in, one)));
                                   })));
}

}  // namespace base
