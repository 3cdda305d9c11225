// The comment that a header opens with: what it computes, how well, and where it comes from.
#pragma once

#include <string>

#include "bench/generate/header.hpp"
#include "bench/generate/kernel_data.hpp"

namespace generate {

/// \param data  is given the places of this comment
[[nodiscard]] std::string opening_comment(const Spec& spec, KernelData& data);

}  // namespace generate
