// What a controller is made for, and the two sums that it takes.
#pragma once

#include <cstddef>
#include <optional>

#include "drive/controller_file.hpp"

namespace generate {

struct ControllerSpec {
    drive::Fopid controller;
    double max_error = 5e-4;          ///< of the integral's weights, the sum of magnitudes, before powers of h
    std::size_t horizon = 1'000'000;  ///< samples that it counts over
    std::optional<double> input_full_scale =
        {};  ///< in q31, of set point and measured value; without: single precision
    /// The word of its format.
    [[nodiscard]] const char* format() const { return input_full_scale ? "q31" : "f32"; }
};

/// What the derivative's weights may be off by, times `max_error`: nothing adds their errors up.
inline constexpr double derivative_share = 2.0;

/// The two sums of a controller: of order 1 - lambda over the error, of order mu over the weighted one.
struct SumOfController {
    double order;
    std::size_t taps;  ///< within the error
};
/// \throws glsum::Failure (check failed) where no length keeps the error
[[nodiscard]] SumOfController integral_sum(const ControllerSpec& spec);
[[nodiscard]] SumOfController derivative_sum(const ControllerSpec& spec);

/// The kernel of the integral's sum: each state carries what its steps lost, or slow ones would stop. In q31 they do
/// stop, 2^-32 of full scale over their decay from where they should.
[[nodiscard]] const char* integral_kernel(const ControllerSpec& spec);
/// And of the derivative's, whose slow states weigh next to nothing.
[[nodiscard]] const char* derivative_kernel(const ControllerSpec& spec);

/// h / (h + filter_s), h^lambda, h^-mu.
struct Factors {
    double passes;
    double integral;
    double derivative;
};
[[nodiscard]] Factors factors_of(const drive::Fopid& controller);

}  // namespace generate
