#include "bench/steppers/model/full_memory.hpp"

#include <algorithm>
#include <cmath>

#include "drive/fast_memory.hpp"

namespace generate {
namespace {

// Its numbers, with as many taps as a record has samples.
drive::RealtimeModel design_of(const ModelSpec& spec, std::size_t samples) {
    return {spec.model, spec.writing, {has_tail(spec.model) ? samples + 1 : whole_order_taps}, spec.step_s};
}

// y of increments that are `forcing` but for what the output before and the past take off.
std::vector<double> respond_to(const glsum::ModelDesign& numbers, const std::vector<double>& forcing) {
    std::vector<double> weights(forcing.size() + 1, 0.0);
    if (!numbers.tables.empty()) {
        const glsum::PastTable& table = numbers.tables[0];
        weights[1] = table.factor;
        for (std::size_t j = 0; j < std::min(table.ratios.size(), forcing.size() - 1); ++j) {
            weights[2 + j] = table.factor * table.ratios[j];
        }
    }
    drive::FastMemory memory(weights);
    std::vector<double> output;
    double y = 0.0;
    for (const double one : forcing) {
        const double increment = one - numbers.constant * y - memory.past();
        memory.push(increment);
        y += increment;
        output.push_back(y);
    }
    return output;
}

}  // namespace

bool has_tail(const drive::Model& model) {
    return std::any_of(model.denominator.begin(), model.denominator.end(),
                       [](const drive::Term& term) { return term.order != std::floor(term.order); });
}

std::vector<double> full_memory(const ModelSpec& spec, const std::vector<double>& input) {
    const drive::RealtimeModel design = design_of(spec, input.size());
    const glsum::ModelDesign& numbers = design.design();
    const std::size_t behind = numbers.delay + 1;
    const auto acting = [&](std::size_t k) { return k >= behind ? input[k - behind] : 0.0; };
    std::vector<double> forcing;
    for (std::size_t k = 0; k < input.size(); ++k) {
        forcing.push_back(numbers.input * (numbers.half_input ? 0.5 * (acting(k) + acting(k + 1)) : acting(k)));
    }
    return respond_to(numbers, forcing);
}

Swing swing_of(const ModelSpec& spec) {
    const drive::RealtimeModel design = design_of(spec, spec.samples);
    std::vector<double> impulse(spec.samples, 0.0);
    impulse[0] = 1.0;
    Swing swing{0.0, 0.0};
    double before = 0.0;
    for (const double output : respond_to(design.design(), impulse)) {
        swing.output += std::fabs(output);
        swing.increments += std::fabs(output - before);
        before = output;
    }
    return swing;
}

}  // namespace generate
