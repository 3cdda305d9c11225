// The comment that a header opens with: what it computes, how well, and where it comes from.
#pragma once

#include <string>

#include "bench/generate/header.hpp"
#include "bench/generate/kernel_data.hpp"
#include "bench/generate/text.hpp"

namespace generate {

[[nodiscard]] std::string opening_comment(const Spec& spec, const KernelData& data, const Places& places);

}  // namespace generate
