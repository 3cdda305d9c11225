// A sum of a controller as a registered kernel steps it, here.
#pragma once

#include <string>

#include "bench/steppers/controller/controller_spec.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"

namespace generate {

template <class Kernel>
[[nodiscard]] glsum::Design design_of(const SumOfController& sum, const ControllerSpec& spec) {
    const std::string name(Kernel::name());
    const bench::Length length = bench::length_of(name, sum.order, sum.taps, spec.horizon);
    return bench::design_of(name, sum.order, length, spec.horizon);
}

}  // namespace generate
