// What disturbs a plant is filtered by it: it is slow, as no sensor's noise is, and yet knows nothing of the input.
// Source of the test by the inputs: [Ljung1999] L. Ljung, System Identification: Theory for the User, 2nd ed., 16.6.
#pragma once

#include <vector>

#include "gap/drive/residuals/flexible.hpp"

namespace gap {

struct Disturbance {
    double rms = 0.0;          ///< about each record's mean, in units of the readings
    double mean_square = 0.0;  ///< of these means
    double times_anew = 0.0;   ///< how often there is anything new in it: samples, over how many apart that is
    bool even = false;         ///< no stretch is far louder than the usual one, and no wave stands out
};

/// \param least_square  what each stretch holds at least: of a quantum, or of rounding
[[nodiscard]] Disturbance disturbance_of(const std::vector<Remainder>& records, double least_square);

/// Of what counts.
void take_off_mean(Remainder& one);

/// Whether what is left where it was judged can be the same stationary noise as where it was fitted: as large, anew
/// often enough in both to say so, and even.
[[nodiscard]] bool are_one_disturbance(const Disturbance& fitted, const Disturbance& judged);

}  // namespace gap
