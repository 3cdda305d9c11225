// Lists of counts as a person types them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace cli {

/// What a list holds: `most` and `fewest` of `what`, named by the option that it was given to.
struct Counted {
    std::string option;
    std::string what;
    std::size_t fewest;
    std::size_t most;
};

/// The counts, rising, each once. \throws glsum::Failure (bad input) naming the word that is none or out of range
[[nodiscard]] std::vector<std::size_t> to_rising(const std::vector<std::string>& words, const Counted& counted);

}  // namespace cli
