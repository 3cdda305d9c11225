// A model in q31 as a generated header steps it, here: the library's own stepper.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "bench/steppers/model/full_memory.hpp"

namespace generate {

class FixedModel {
public:
    /// \param swing  `swing_of(spec)` \pre spec.input_full_scale, above 0
    /// \throws glsum::Failure (bad input) as `drive::RealtimeModel`
    FixedModel(const ModelSpec& spec, const Swing& swing);
    ~FixedModel();
    FixedModel(const FixedModel&) = delete;
    FixedModel& operator=(const FixedModel&) = delete;

    /// y_k for u_k, each a fraction of its full scale, from rest; u_k acts from the next sample on, behind the dead
    /// time.
    std::int32_t step(std::int32_t input);
    /// The same with inputs rounded to the format.
    double step_real(double input);
    /// What did not fit since the start.
    [[nodiscard]] std::uint32_t saturations() const;
    [[nodiscard]] const drive::RealtimeModel& design() const;

    /// Above whatever inputs within full scale make of y over the spec's samples.
    [[nodiscard]] double output_full_scale() const;
    /// How far y is off at most over these samples, from exact arithmetic with the design's taps and modes.
    [[nodiscard]] double error() const { return error_; }

    /// A factor as the stepper holds it: its products shifted to the units of the increments.
    struct Factor {
        std::int32_t mantissa;
        int shift;
        bool negative;
    };
    [[nodiscard]] Factor input() const;
    [[nodiscard]] Factor constant() const;
    [[nodiscard]] Factor past() const;  ///< \pre there is a table
    /// From the output's sum to y's units.
    [[nodiscard]] int output_shift() const;

private:
    struct State;
    std::unique_ptr<State> state_;
    double error_ = 0.0;
};

}  // namespace generate
