// One kernel at one order and length as a C99 header.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/sweep/sweep.hpp"
#include "glsum/design/band.hpp"

namespace generate {

/// What to generate.
struct Spec {
    std::string kernel;
    double order;                  ///< v, in (-2, 2]
    std::size_t taps;              ///< L >= 1; of a kernel with modes its near taps and two for each mode
    std::optional<double> step_s;  ///< gives the factor h^-v, where it is known
    std::string prefix = "glsum";  ///< of every identifier
    std::string part = {};         ///< stands behind it, in a header of several sums
    std::string licence = {};      ///< what the comment ends with; nothing where it is empty
    std::size_t horizon = 5000;    ///< samples that a design with modes is for
    std::optional<glsum::design::FittedFilter> fitted = {};  ///< in place of the order's own weights, with `step_s`
    std::string fitted_by = "a filter fitted to the derivative";  ///< whose filter that is
    bool past_of_model = false;                                   ///< what is fitted stands for a model's past
    std::string use = {};  ///< with it, what the comment says first: where it may be used, and how near it comes
    std::vector<std::string> provenance;  ///< lines of the comment: where it comes from, what was measured
};

/// Its coefficients by kind: of the fitted filter where there is one.
[[nodiscard]] bench::Length length_of(const Spec& spec);

/// Kernels that can be generated, in the registry's order.
[[nodiscard]] std::vector<std::string> generatable();

/// The header: constant table, instance, init, step, and a self-check with outputs of the registered kernel.
/// \throws glsum::Failure (bad input) for a kernel that is not there or cannot be generated, a prefix that is no
///         identifier, and a design that the kernel refuses.
[[nodiscard]] std::string make_header(const Spec& spec);

/// The inputs of every self-check, as reals.
[[nodiscard]] std::vector<double> check_signal();

/// The word of a kernel's format, which ends the names of the header's functions. \throws std::out_of_range for another
/// name
[[nodiscard]] std::string format_word(const std::string& kernel);

}  // namespace generate
