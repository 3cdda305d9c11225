// Which kernels a core without a double unit carries out in software.
#pragma once

#include <concepts>

#include "glsum/kernel.hpp"

namespace glsum {

/// Whether a kernel's calls compute in double precision.
template <Kernel K>
constexpr bool computes_in_double() {
    bool computes = std::same_as<typename K::Sample, double> || std::same_as<typename K::Coefficient, double> ||
                    std::same_as<typename K::Output, double>;
    if constexpr (requires { typename K::FormatPart::Accumulator; }) {
        computes = computes || std::same_as<typename K::FormatPart::Accumulator, double>;
    }
    return computes;
}

}  // namespace glsum
