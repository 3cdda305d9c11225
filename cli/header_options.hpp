// What is typed of the header to be generated, beside the budget.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/generate/header.hpp"
#include "cli/budget.hpp"
#include "cli/output.hpp"

namespace cli {

struct HeaderOptions {
    std::string kernel;
    std::string taps;
    std::string prefix;
    std::string licence;
    std::string out;
    std::string controller;
    std::string model;
    std::string plant;
    std::string format;
    std::optional<double> input_scale;
    Output json;
    bool verify = false;
};

/// The full scale of what comes in, of a header in q31; none in f32. \param of  what it is the full scale of
/// \throws glsum::Failure (bad input) for another format, a scale that lacks, is not above 0 or has no use
[[nodiscard]] std::optional<double> input_full_scale(const std::string& format, const std::optional<double>& scale,
                                                     const char* of);

/// Kernels that match what was typed; one that is there but cannot be generated is refused by name later. Of several
/// those that do not take the order are left out, and named on the terminal.
[[nodiscard]] std::vector<std::string> named_kernels(const std::string& glob, double order);

/// The length as a kernel counts it: a number, or 2+7 of near taps and modes or blocks.
/// \throws glsum::Failure (bad input) for one that a design of so many coefficients parts otherwise
[[nodiscard]] std::size_t to_taps(const std::string& text, const std::string& kernel, double order,
                                  std::size_t samples);

[[nodiscard]] generate::Spec to_spec(const HeaderOptions& options, const Budget& budget, const std::string& kernel,
                                     std::size_t taps);

}  // namespace cli
