// All that a header needs of a registered kernel: its texts, what decides between them, its numbers and its outputs.
#pragma once

#include "bench/generate/header.hpp"
#include "bench/texts/template.hpp"

namespace generate {

/// The chains "history", "sum", "format" and "header", with facts and places for all of them but those of the opening
/// comment. \throws glsum::Failure (bad input) for a kernel that is not there or cannot be generated, and for a design
/// that the kernel refuses.
[[nodiscard]] HeaderText kernel_text(const Spec& spec);

}  // namespace generate
