// Simulation by the Grünwald-Letnikov scheme, as a microcontroller steps it: [Matusiak2020] (3) in every term of (5).
//
//   sum_i a_i h^-alpha_i sum_{j>=0} w_j^(alpha_i) y_(k-j) = forcing_k      solved for y_k, with y_0 = 0
//
// The input is held between samples: y_k is driven by the input up to t_k, so by the sample before, u_(k-1); a step at
// the first sample forces the second. That leaves 5.4e-4 to the exact response of (12) at h = 1 ms; forcing with u_k
// doubles it. For an input that is given at the samples and is continuous between, `Forcing::sampled` takes u_k.
//
// In increments the same scheme acts on d_k = y_k - y_(k-1) with the orders alpha_i - 1: the same numbers in exact
// arithmetic and full memory, but nothing of the size of y is rounded in the sums, and a shortened memory forgets old
// increments instead of old values.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drive/log.hpp"
#include "drive/model.hpp"

namespace drive {

enum class Forcing { held, sampled };

struct Scheme {
    double step_s = 0.001;
    std::optional<std::size_t> taps =
        {};  ///< coefficients of each sum, the newest's included; all there are if not given
    bool increments = false;
    bool merged = false;  ///< one table sum_i a_i h^-alpha_i w_j^(alpha_i) for all orders instead of a sum for each
    Forcing forcing = Forcing::held;
    /// A kernel of the registry, which evaluates one sum for each order in its own numbers; the operations around the
    /// sums are in its output's precision (double around fixed point). Empty: one merged table in double, full memory
    /// by blocks (`FastMemory`).
    std::string kernel = {};
    /// Fixed point: the output that stands for 1. 0: chosen as the power of two above twice the largest steady output.
    double full_scale = 0.0;
};

struct Simulated {
    std::vector<double> output;
    std::size_t saturations = 0;  ///< fixed point: samples and sums that did not fit
    double full_scale = 0.0;      ///< fixed point: what was taken
};

/// The output for an input sampled every `scheme.step_s`, zero before. A dead time counts in whole steps, rounded up:
/// the last sample that has come through acts. Choose a step that divides it. \throws glsum::Failure (bad input): a
/// step that is not above 0, no kernel of that name, one that cannot do an order or a length of this model.
[[nodiscard]] Simulated simulate(const Model& model, const Scheme& scheme, std::span<const double> input);

/// Whether the dead time is a whole number of steps, to 1e-9 of a step or of the dead time.
[[nodiscard]] bool delay_fits(const Model& model, double step_s);

/// The merged table of one side: sum_i c_i h^-order_i w_j^(order_i), j = 0 .. count - 1, oldest first or not. With
/// `increments` the orders are one lower, and terms of order 0 are left out.
[[nodiscard]] std::vector<double> merged_weights(const std::vector<Term>& terms, double step_s, std::size_t count,
                                                 bool increments = false);

/// An input by name, for a record of `until_s` seconds.
struct Excitation {
    std::string name = "step";  ///< `step`, `pulse` or `staircase`
    double amplitude = 1.0;     ///< 0.27 for the pulse width of 27 %
    double off_s = 2.6;         ///< when the pulse ends
    std::size_t stairs = 4;     ///< equal stairs up and down again over the record
};

/// Samples at k step_s, k = 0 .. floor(until_s / step_s).
/// \throws glsum::Failure (bad input): no such name, a record of less than two samples or more than 10^7 steps.
[[nodiscard]] std::vector<double> make_input(const Excitation& excitation, double step_s, double until_s);

/// The same as a log without an output, called as the input. \throws as `make_input`
[[nodiscard]] Log make_log(const Excitation& excitation, double step_s, double until_s);

}  // namespace drive
