#include "bench/steppers/controller/certificate.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/failure.hpp"
#include "bench/steppers/controller/held_controller.hpp"

namespace generate {
namespace {

std::string found_text(const tune::Margins& margins) {
    return margins.unstable_poles < 0 ? std::string("L through -1")
                                      : fmt::format("{} pole{} outside the unit circle", margins.unstable_poles,
                                                    margins.unstable_poles == 1 ? "" : "s");
}

}  // namespace

tune::Margins certify(const ControllerSpec& spec, const drive::Model& plant, const std::string& name,
                      const std::string& plant_name) {
    const double step_s = spec.controller.sample_time_s;
    const drive::Gains& gains = spec.controller.gains;
    const tune::SampledPlant sampled(plant, step_s, plant_name);
    const auto stepped = stepped_of(spec);
    constexpr double below = 0.01;  // of a state's corner: its phase is 0.6 degrees from the limit's
    const tune::Margins margins =
        tune::margins_of(sampled, {[&](double w) { return stepped->response(w * step_s); }, gains.ki != 0.0 ? 1.0 : 0.0,
                                   below * stepped->slowest() / step_s});
    if (!margins.stable()) {
        const bool exact = tune::margins_of({&sampled, gains}).stable();
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format(
                "{}: expected a stable loop with {}, sampled every {} s, found {} (by the argument principle){}", name,
                plant_name, step_s, found_text(margins),
                exact ? "; with its exact orders the loop is stable: a smaller --max-error may do" : ""));
    }
    return margins;
}

std::string margins_text(const tune::Margins& margins) {
    const std::string gain = std::isfinite(margins.gain)
                                 ? fmt::format("{:.3g} at {:.3g} rad/s", margins.gain, margins.phase_crossover)
                                 : "none";
    const std::string phase = margins.crossings > 0 ? fmt::format("{:.1f} degrees (crossover {:.3g} rad/s)",
                                                                  margins.phase_deg, margins.crossover)
                                                    : "none";
    return fmt::format("gain margin {}, phase margin {}, largest |S| {:.3f} at {:.3g} rad/s", gain, phase,
                       margins.sensitivity, margins.sensitivity_at);
}

}  // namespace generate
