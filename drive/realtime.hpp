// A model as a microcontroller steps it in real time: the numbers of `kernels/model/stepper.hpp`, designed here.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drive/model.hpp"
#include "model/stepper.hpp"

namespace drive {

/// How the scheme is written, and so how its past is kept. In names the word follows the history's: ring, ringdelta,
/// ringapart.
enum class Writing {
    merged,  ///< the textbook's, one table for all orders, on values of the output
    delta,   ///< one table, on increments of the output
    apart,   ///< the textbook's, a table for each order
};
[[nodiscard]] const char* word_of(Writing writing);

/// `ring_oldest_f32` written in increments is `ringdelta_oldest_f32`.
[[nodiscard]] std::string realtime_name(const std::string& kernel, Writing writing);

/// The numbers, and what they point into. Scales of fixed point are for inputs up to 1 in magnitude: powers of two
/// above what any such input can cause.
class RealtimeModel {
public:
    /// \param taps  coefficients of each sum, the newest's included; trailing zeros of whole orders are left out
    /// \throws glsum::Failure (bad input): a numerator, more than 4 tables, a step or a length that is not above 0, a
    /// table whose first past coefficient is 0.
    RealtimeModel(const Model& model, Writing writing, std::size_t taps, double step_s);
    RealtimeModel(const RealtimeModel&) = delete;
    RealtimeModel& operator=(const RealtimeModel&) = delete;
    RealtimeModel(RealtimeModel&&) = default;  // vectors keep their places
    RealtimeModel& operator=(RealtimeModel&&) = default;
    ~RealtimeModel() = default;

    [[nodiscard]] const glsum::ModelDesign& design() const { return design_; }
    /// Coefficients of the longest sum, the newest's included.
    [[nodiscard]] std::size_t taps() const { return taps_; }

private:
    std::vector<std::vector<double>> ratios_;
    std::vector<glsum::PastTable> tables_;
    glsum::ModelDesign design_;
    std::size_t taps_ = 1;
};

/// The largest length that a straight line through two counted lengths leaves within a budget.
/// \pre long_taps > short_taps  \return 0 if not even a sum of one term fits
[[nodiscard]] std::size_t largest_taps(double short_taps, double short_cost, double long_taps, double long_cost,
                                       double budget);

}  // namespace drive
