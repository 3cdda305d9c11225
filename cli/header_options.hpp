// What is typed of the header to be generated, beside the budget.
#pragma once

#include <cstddef>
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
    Output json;
    bool verify = false;
};

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
