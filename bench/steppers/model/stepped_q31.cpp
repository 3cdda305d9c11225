#include "bench/steppers/model/stepped_q31.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/failure.hpp"
#include "bench/rows/row.hpp"
#include "glsum/bound.hpp"
#include "glsum/model/stepper.hpp"

namespace generate {
namespace {

using Kernel = glsum::modes_plain_q31;
using Stepper = glsum::Stepper<Kernel>;

// A hundredth above, for what rounding adds.
double power_of_two_above(double value) { return std::exp2(std::ceil(std::log2(1.01 * value))); }

}  // namespace

struct FixedModel::State {
    explicit State(const ModelSpec& spec)
        : design(spec.model, spec.writing, spec.memory, spec.step_s, spec.samples),
          full_scale(*spec.input_full_scale) {}
    drive::RealtimeModel design;
    double full_scale;
    glsum::ModelDesign numbers{};
    Stepper::State stepper{};
    std::vector<std::int32_t> table;
    std::vector<std::int32_t> past;
    std::vector<std::int32_t> waiting;

    [[nodiscard]] Factor factor(const glsum::Gain& gain, int exponent, unsigned bit) const {
        return {gain.mantissa, glsum::gain_shift(gain, exponent, 0), (stepper.negative >> bit & 1U) != 0};
    }
};

FixedModel::FixedModel(const ModelSpec& spec, const Swing& swing) : state_(new State(spec)) {
    State& state = *state_;
    glsum::ModelDesign& numbers = state.numbers;
    numbers = state.design.design();
    // Of an input of 1. What the modes leave of the past is fed back, and swings the more.
    const double modes = 1.0 / (1.0 - state.design.loop_gain());
    const double input = std::fabs(numbers.input);
    numbers.input_full_scale = 1.0;
    numbers.stored_full_scale = power_of_two_above(modes * input * swing.increments);
    numbers.output_full_scale = std::max(numbers.stored_full_scale, power_of_two_above(modes * input * swing.output));
    for (const glsum::PastTable& one : numbers.tables) {
        state.table.resize(Stepper::table_count(one));
        state.past.resize(Stepper::past_count(one));
    }
    state.waiting.resize(Stepper::line_count(numbers.delay));
    if (const glsum::Status status = Stepper::prepare(state.stepper, numbers, state.table, state.past, state.waiting);
        status != glsum::Status::ok) {
        throw glsum::Failure(glsum::Exit::bad_input, "the model: " + bench::to_text(status));
    }
    // Of an increment, at each sample: products rounded once, factors to 2^-31 of themselves, y to the half of a unit
    // where it is multiplied, the sum of the past as its kernel, the mean of two inputs down.
    const double stored = numbers.stored_full_scale;
    double each = 0.5 * std::ldexp(stored, -31) + std::ldexp(input, -31);
    each += numbers.half_input ? std::ldexp(input, -32) : 0.0;
    if (numbers.constant != 0.0) {
        const double held = std::fabs(numbers.constant) * numbers.output_full_scale;
        each += 0.5 * std::ldexp(stored, -31) + std::ldexp(1.5 * held, -31);
    }
    for (const glsum::PastTable& one : numbers.tables) {
        const double factor = std::fabs(one.factor) * stored;
        const auto& sum = state.stepper.sums[0];
        each += 0.5 * std::ldexp(stored, -31) + std::ldexp(factor, sum.scale.output_exponent - 31) +
                factor * glsum::error_bound<Kernel>(one.design(), sum, 1.0);
    }
    error_ = state.full_scale * (each * swing.output * modes + 0.5 * std::ldexp(numbers.output_full_scale, -31));
}

FixedModel::~FixedModel() = default;

std::int32_t FixedModel::step(std::int32_t input) {
    return glsum::round_shift(Stepper::step(state_->stepper, input), state_->stepper.output_shift).value;
}

double FixedModel::step_real(double input) {
    return step(Kernel::from_real(input / state_->full_scale)) * std::ldexp(output_full_scale(), -31);
}

std::uint32_t FixedModel::saturations() const { return state_->stepper.saturations; }
const drive::RealtimeModel& FixedModel::design() const { return state_->design; }
double FixedModel::output_full_scale() const { return state_->full_scale * state_->numbers.output_full_scale; }
FixedModel::Factor FixedModel::input() const { return state_->factor(state_->stepper.input, 0, 16); }
FixedModel::Factor FixedModel::constant() const { return state_->factor(state_->stepper.constant, 0, 17); }
FixedModel::Factor FixedModel::past() const {
    return state_->factor(state_->stepper.factor[0], state_->stepper.sums[0].scale.output_exponent, 0);
}
int FixedModel::output_shift() const { return state_->stepper.output_shift; }

}  // namespace generate
