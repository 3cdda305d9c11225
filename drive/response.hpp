// What a model does with an input: the exact response, to about nine digits, at any times.
#pragma once

#include <span>
#include <vector>

#include "drive/inverse_laplace.hpp"
#include "drive/model.hpp"

namespace drive {

/// The input changes by `size` at `time_s` and is held until the next change: how a zero-order hold makes it.
struct Change {
    double time_s;
    double size;
};

/// The changes of an input with the value `values[i]` from `times_s[i]` on, 0 before the first. Times rise.
[[nodiscard]] std::vector<Change> changes_of(std::span<const double> times_s, std::span<const double> values);

/// The response to a unit step, and to held inputs by superposition.
class StepResponse {
public:
    explicit StepResponse(const Model& model);
    /// At `t_s` after the step; 0 until the dead time is over.
    double operator()(double t_s) { return inverse_(t_s - delay_s_); }

private:
    InverseLaplace inverse_;
    double delay_s_;
};

/// The output at `times_s`, from rest. Costs a polynomial of degree 15 for each time and each change before it.
[[nodiscard]] std::vector<double> respond(StepResponse& step, std::span<const Change> changes,
                                          std::span<const double> times_s);
[[nodiscard]] std::vector<double> respond(const Model& model, std::span<const Change> changes,
                                          std::span<const double> times_s);

}  // namespace drive
