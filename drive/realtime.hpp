// A model as a microcontroller steps it in real time: the numbers of `kernels/glsum/model/stepper.hpp`, designed here.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drive/model.hpp"
#include "glsum/model/stepper.hpp"

namespace drive {

/// How the scheme is written, and so how its past is kept. In names the word follows the history's: ring, ringdelta,
/// ringapart, ringbdf2.
enum class Writing {
    merged,  ///< the textbook's, one table for all orders, on values of the output
    delta,   ///< one table, on increments of the output
    apart,   ///< the textbook's, a table for each order
    bdf2,    ///< as delta, of second order in h: weights by BDF2 [Lubich1986], the input's jumps at their half
};
[[nodiscard]] const char* word_of(Writing writing);

/// `ring_oldest_f32` written in increments is `ringdelta_oldest_f32`.
[[nodiscard]] std::string realtime_name(const std::string& kernel, Writing writing);

/// How far back a model's sums see.
struct Memory {
    std::size_t taps;       ///< coefficients of each sum, the newest's included; a mode counts as two
    std::size_t modes = 0;  ///< exponentials behind the first taps - 2 modes
    /// "600"; "2+7": near taps and modes.
    [[nodiscard]] std::string text() const {
        return modes == 0 ? std::to_string(taps) : std::to_string(taps - 2 * modes) + '+' + std::to_string(modes);
    }
};

/// The numbers, and what they point into. Scales of fixed point are for inputs up to 1 in magnitude: powers of two
/// above what any such input can cause.
class RealtimeModel {
public:
    /// \param memory   trailing zeros of whole orders are left out, and then there are no modes
    /// \param horizon  with modes: for how many samples their tail is designed
    /// \throws glsum::Failure (bad input): a numerator, more than 4 tables, a step or a length that is not above 0, a
    /// table whose first past coefficient is 0; modes elsewhere than on increments, behind fewer than 2 taps, or with a
    /// loop gain of 1 or above.
    RealtimeModel(const Model& model, Writing writing, const Memory& memory, double step_s,
                  std::size_t horizon = 60'000);
    RealtimeModel(const RealtimeModel&) = delete;
    RealtimeModel& operator=(const RealtimeModel&) = delete;
    RealtimeModel(RealtimeModel&&) = default;  // vectors keep their places
    RealtimeModel& operator=(RealtimeModel&&) = default;
    ~RealtimeModel() = default;

    [[nodiscard]] const glsum::ModelDesign& design() const { return design_; }
    /// With modes: how far their table is off (the sum of the magnitudes), times what the exact scheme makes of a
    /// disturbance of its right-hand side (the sum of the magnitudes of its increments, each of 1 caused by one
    /// sample). Below 1 the loop is stable, by the small-gain theorem. 0 without modes.
    [[nodiscard]] double loop_gain() const { return loop_gain_; }
    /// Of the longest sum.
    [[nodiscard]] const Memory& memory() const { return memory_; }

private:
    std::vector<std::vector<double>> ratios_;
    std::vector<glsum::Mode> modes_;
    std::vector<glsum::PastTable> tables_;
    glsum::ModelDesign design_;
    Memory memory_{1};
    double loop_gain_ = 0.0;
};

/// The largest length that a straight line through two counted lengths leaves within a budget.
/// \pre long_taps > short_taps  \return 0 if not even a sum of one term fits
[[nodiscard]] std::size_t largest_taps(double short_taps, double short_cost, double long_taps, double long_cost,
                                       double budget);

}  // namespace drive
