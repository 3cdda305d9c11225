// The comment that a header opens with: what it computes, how well, and where it comes from.
#pragma once

#include <string>

#include "bench/generate/header.hpp"
#include "bench/texts/template.hpp"

namespace generate {

/// \param header  of `kernel_text`, which is given the places of this comment
[[nodiscard]] std::string opening_comment(const Spec& spec, HeaderText& header);

}  // namespace generate
