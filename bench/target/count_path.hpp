// What decides which instructions a kernel executes, besides its length: from this follows which counts can be shared.
#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <utility>

#include "glsum/kernel.hpp"

namespace bench {

/// Two designs of equal kernel, length and path execute the same instructions, whatever the order and the data, but for
/// double precision in software. Fixed point shifts its sum as the scale demands, left, right or not at all, and the
/// scale follows from the order.
struct CountPath {
    glsum::Status status = glsum::Status::ok;
    int table_exponent = 0;
    int output_exponent = 0;
    std::size_t modes = 0;
    std::pair<std::size_t, std::size_t> blocks = {};  ///< their number, and how many a level has
    auto operator<=>(const CountPath&) const = default;
};
/// \throws std::out_of_range for a kernel that is not in the registry.
[[nodiscard]] CountPath count_path(const std::string& kernel, const glsum::Design& design);

/// Whether the kernel computes in double precision, which the target does in software, with data-dependent counts.
/// \throws std::out_of_range for a kernel that is not in the registry.
[[nodiscard]] bool double_in_software(const std::string& kernel);

}  // namespace bench
