// Numbers as files have them.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace gap {

/// A number, a word or a list of numbers.
using ContractValue = std::variant<double, std::string, std::vector<double>>;

struct Written {
    std::string name;
    ContractValue value;
    std::vector<std::pair<double, double>> intervals = {};  ///< of the number, or of each of the list; empty: none
    std::string unit = {};  ///< u and y: those of input and output; "1" or empty: it has none
};

}  // namespace gap
