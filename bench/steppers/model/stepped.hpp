// A model in single precision as a generated header steps it, here: the library's own stepper.
#pragma once

#include <memory>

#include "bench/steppers/model/model_spec.hpp"

namespace generate {

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
