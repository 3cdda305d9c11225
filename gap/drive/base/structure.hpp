// Which linear descriptions a base is looked for among: lags, whole or fractional, integrators, zeros, each with a dead
// time.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "drive/form.hpp"

namespace gap {

/// gain (1 + b_1 s + ...) / (s^integrators (1 + a_1 s + ... )) exp(-delay_s s), of `order` in all.
struct Structure {
    const char* name;
    int order;
    int integrators;
    int zeros;
    const char* meaning;      ///< for people
    bool fractional = false;  ///< orders are numbers of their own, each about a whole one
    /// Numbers of its own beside the dead time: what a richer one must pay for.
    [[nodiscard]] int numbers() const { return 1 + (fractional ? 2 : 1) * (order - integrators) + zeros; }
};

/// The simplest first.
[[nodiscard]] const std::vector<Structure>& structures();
/// Null: there is none of that name.
[[nodiscard]] const Structure* structure_named(const std::string& name);

/// Values of a structure's numbers.
struct Coefficients {
    double gain = 1.0;
    std::vector<double> denominator;  ///< a_1 upwards, `order - integrators` of them, in powers of seconds
    std::vector<double> numerator;    ///< b_1 upwards
    double delay_s = 0.0;
    std::vector<double> orders = {};  ///< of a fractional structure, one for each of `denominator`
};

/// A lag and an oscillator behind each other: (1 + lag_s s)(1 + 2 damping period_s s + (period_s s)^2), of
/// `third_order`.
[[nodiscard]] Coefficients lag_and_oscillator(double lag_s, double period_s, double damping, double delay_s);

/// The range of a fractional structure's order that stands for a whole one: below it two would meet, above it a lag
/// swings.
[[nodiscard]] double lowest_order(std::size_t whole);
[[nodiscard]] double highest_order(std::size_t whole);

/// The form whose free numbers are the structure's: whole orders stay, what stands before the lowest power is 1.
/// \param driven  false: nothing is put in, so that a gain and a dead time are told by nothing and stay
[[nodiscard]] drive::Form form_of(const Structure& structure, const Coefficients& at, bool driven);

}  // namespace gap
