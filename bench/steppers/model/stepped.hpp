// A model in single precision as a generated header steps it, here: the library's own stepper.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "drive/realtime.hpp"

namespace generate {

/// What a model's header is made for.
struct ModelSpec {
    drive::Model model;
    double step_s = 0.001;
    std::size_t samples = 60'000;                    ///< that its sum's tail is designed for
    drive::Writing writing = drive::Writing::delta;  ///< delta or bdf2: on increments
    drive::Memory memory{2};                         ///< near taps and modes
    bool compensated = false;                        ///< states and output carry what their additions lost
    /// The kernel of its sum.
    [[nodiscard]] const char* kernel() const { return compensated ? "modes_compensated_f32" : "modes_plain_f32"; }
};

class SteppedModel {
public:
    /// \throws glsum::Failure (bad input) as `drive::RealtimeModel`
    explicit SteppedModel(const ModelSpec& spec);
    ~SteppedModel();
    SteppedModel(const SteppedModel&) = delete;
    SteppedModel& operator=(const SteppedModel&) = delete;
    /// y_k for u_k, from rest; u_k acts from the next sample on, behind the dead time.
    float step(float input);
    [[nodiscard]] const drive::RealtimeModel& design() const;

private:
    class Stepping;
    std::unique_ptr<Stepping> stepper_;
};

}  // namespace generate
