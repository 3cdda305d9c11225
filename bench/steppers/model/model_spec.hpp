// What a model's header is made for.
#pragma once

#include <cstddef>
#include <optional>

#include "drive/realtime.hpp"

namespace generate {

struct ModelSpec {
    drive::Model model;
    double step_s = 0.001;
    std::size_t samples = 60'000;                    ///< that its sum's tail is designed for
    drive::Writing writing = drive::Writing::delta;  ///< delta or bdf2: on increments
    drive::Memory memory{2};                         ///< near taps and modes
    bool compensated = false;                        ///< f32: states and output carry what their additions lost
    std::optional<double> input_full_scale = {};     ///< in q31; without: single precision
    /// The word of its format, and the kernel of its sum.
    [[nodiscard]] const char* format() const { return input_full_scale ? "q31" : "f32"; }
    [[nodiscard]] const char* kernel() const {
        return input_full_scale ? "modes_plain_q31" : compensated ? "modes_compensated_f32" : "modes_plain_f32";
    }
};

}  // namespace generate
