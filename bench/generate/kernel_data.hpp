// All that a header needs of a registered kernel: its texts, with what decides between them, its numbers and its
// outputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/generate/header.hpp"
#include "bench/generate/literals.hpp"
#include "bench/generate/template.hpp"

namespace generate {

struct KernelData {
    HeaderText text;      ///< of the chains "history", "sum" and "format"
    double design_error;  ///< with modes or blocks: against full memory over the horizon, for |x| <= 1
    double error_bound;   ///< for |x| <= 1, over the horizon
    Numbers table;
    Numbers inputs;                      ///< of the self-check
    std::vector<std::uint64_t> outputs;  ///< their bits, for the inputs repeated
    std::uint64_t hash;                  ///< of the outputs, as targets/shared/output_hash.hpp has it
};

/// \param calls  outputs wanted \throws glsum::Failure (bad input) for a kernel that is not there or cannot be
/// generated, and for a design that the kernel refuses.
[[nodiscard]] KernelData describe(const Spec& spec, const std::vector<double>& inputs, std::size_t calls);

}  // namespace generate
