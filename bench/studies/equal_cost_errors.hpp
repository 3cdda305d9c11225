// Errors of measurements at equal cost by what they are of, for the table and the picture.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench {

using EqualCostErrors = std::map<std::string, double>;  ///< "<way>|<cost>|<order>|<signal>"

[[nodiscard]] std::string key_of(std::string_view way, std::size_t cost, const std::string& order,
                                 const std::string& signal);

/// One counter of all rows that have it, of full amplitude alone.
[[nodiscard]] EqualCostErrors errors_by_key(const std::vector<Json>& rows, Counter counter);

}  // namespace bench
