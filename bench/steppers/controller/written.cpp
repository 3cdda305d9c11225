#include "bench/steppers/controller/written.hpp"

#include <bit>
#include <cmath>
#include <memory>
#include <random>

#include "bench/steppers/controller/stepped.hpp"
#include "bench/steppers/controller/stepped_q31.hpp"
#include "glsum/registry.hpp"

namespace generate {

CheckRecord check_record() {
    constexpr std::size_t count = 4000;
    constexpr float levels[] = {1.0F, 0.4F, -0.7F, 0.1F, 0.9F};
    std::mt19937 chance(1);
    CheckRecord record;
    float reading = 0.0F;
    for (std::size_t k = 0; k < count; ++k) {
        const float setpoint = levels[k / 230 % std::size(levels)];
        const float noise = std::ldexp(static_cast<float>(chance() >> 8U), -23) - 1.0F;
        const float size = k < count / 4 * 3 ? 1.0F : 100.0F;
        record.setpoint.push_back(size * setpoint);
        record.measured.push_back(size * (reading + 0.01F * noise));
        reading += 0.01F * (setpoint - reading);
    }
    return record;
}

std::int32_t to_fraction(float value) {
    constexpr double full_scale = 16.0;
    return glsum::modes_plain_q31::from_real(static_cast<double>(value) / full_scale);
}

WrittenStepper written(const ControllerSpec& spec, const std::string& prefix, std::string text) {
    const CheckRecord record = check_record();
    WrittenStepper stepper{prefix, std::move(text), spec.format(), {{}, {}}, {}, {}};
    const auto run = [&](auto stepped, auto&& of_format) {
        for (std::size_t k = 0; k < record.setpoint.size(); ++k) {
            const auto setpoint = of_format(record.setpoint[k]);
            const auto measured = of_format(record.measured[k]);
            stepper.inputs[0].push_back(std::bit_cast<std::uint32_t>(setpoint));
            stepper.inputs[1].push_back(std::bit_cast<std::uint32_t>(measured));
            stepper.expected.push_back(std::bit_cast<std::uint32_t>(stepped->step(setpoint, measured)));
        }
    };
    if (spec.input_full_scale) {
        run(std::make_unique<FixedController>(spec), to_fraction);
    } else {
        run(std::make_unique<SteppedController>(spec), [](float value) { return value; });
    }
    if (integral_sum(spec).taps > 1) {
        stepper.tables.emplace_back("integral");
    }
    if (spec.controller.gains.kd != 0.0 && derivative_sum(spec).taps > 1) {
        stepper.tables.emplace_back("derivative");
    }
    return stepper;
}

ControllerSpec whole_orders(const ControllerSpec& spec) {
    ControllerSpec whole = spec;
    whole.controller.gains.integral_order = 1.0;
    whole.controller.gains.derivative_order = 1.0;
    return whole;
}

}  // namespace generate
