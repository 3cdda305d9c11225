#include "bench/steppers/model/model_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "base/failure.hpp"
#include "base/progress.hpp"
#include "bench/steppers/model/full_memory.hpp"
#include "bench/steppers/model/stepped_q31.hpp"
#include "drive/response.hpp"
#include "drive/stability.hpp"

namespace generate {
namespace {

constexpr std::size_t random_samples = 20'000;
constexpr std::size_t most_modes = 16;

double peak_of(const std::vector<double>& values) {
    double peak = 0.0;
    for (const double value : values) {
        peak = std::max(peak, std::fabs(value));
    }
    return peak;
}

std::vector<ModelSpec> candidates(const ModelSpec& base, bool first_order) {
    std::vector<ModelSpec> all;
    const auto add = [&](drive::Writing writing, std::size_t near_taps, std::size_t modes) {
        for (const bool compensated : {false, true}) {
            if (compensated && base.input_full_scale) {
                continue;  // a state's step loses nothing there that it could keep
            }
            ModelSpec spec = base;
            spec.writing = writing;
            spec.memory = {near_taps + 2 * modes, modes};
            spec.compensated = compensated;
            all.push_back(spec);
        }
    };
    if (!has_tail(base.model)) {
        for (const drive::Writing writing : {drive::Writing::delta, drive::Writing::bdf2}) {
            add(writing, whole_order_taps, 0);
        }
        return all;
    }
    for (std::size_t modes = 1; modes <= most_modes; ++modes) {
        if (first_order) {
            add(drive::Writing::delta, 2, modes);
        }
        // With fewer the loop amplifies what the modes leave: glsum/design/merged.hpp.
        for (const std::size_t near_taps : {4, 5}) {
            add(drive::Writing::bdf2, near_taps, modes);
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const ModelSpec& one, const ModelSpec& other) {
        return one.memory.taps - one.memory.modes < other.memory.taps - other.memory.modes;
    });
    return all;
}

}  // namespace

ModelJudge::ModelJudge(const drive::Model& model, double step_s, std::size_t samples) {
    const auto waits = static_cast<std::size_t>(std::ceil(model.delay_s / step_s - 1e-9));
    std::vector<double> times;
    for (std::size_t k = 0; k <= samples + waits; ++k) {
        times.push_back(static_cast<double>(k) * step_s);
    }
    step_.input.assign(times.size(), 1.0);
    step_.expected = drive::respond(model, std::vector<drive::Change>{{0.0, 1.0}}, times);
    step_.peak = peak_of(step_.expected);
    std::mt19937 chance(1);
    std::vector<double> random;
    for (std::size_t k = 0; k < random_samples + waits; ++k) {
        // Exact in single precision; held for 25 samples, so that a slow model sees it.
        random.push_back(k % 25 == 0 ? std::ldexp(static_cast<double>(chance() >> 8U), -23) - 1.0 : random.back());
    }
    ModelSpec spec{model, step_s, samples};
    random_delta_ = {random, full_memory(spec, random), 0.0};
    spec.writing = drive::Writing::bdf2;
    random_bdf2_ = {random, full_memory(spec, random), 0.0};
    for (Record* const record : {&random_delta_, &random_bdf2_}) {
        record->peak = peak_of(record->expected);
    }
}

template <class Step>
double ModelJudge::error_of(const Record& record, Step&& step) {
    double largest = 0.0;
    for (std::size_t k = 0; k < record.input.size(); ++k) {
        const double output = step(record.input[k]);
        largest = std::max(largest, std::fabs(output - record.expected[k]));
        if (!std::isfinite(output)) {
            return INFINITY;
        }
    }
    return largest / record.peak;
}

double ModelJudge::error_of(const ModelSpec& spec, const Record& record) const {
    if (!spec.input_full_scale) {
        SteppedModel stepped(spec);
        return error_of(record, [&](double input) { return stepped.step(static_cast<float>(input)); });
    }
    FixedModel stepped(spec, swing(spec));
    const double level = fixed_level * *spec.input_full_scale;
    return error_of(record, [&](double input) { return stepped.step_real(level * input) / level; });
}

Swing ModelJudge::swing(const ModelSpec& spec) const {
    auto& known = spec.writing == drive::Writing::delta ? swing_delta_ : swing_bdf2_;
    if (!known) {
        known = swing_of(spec);
    }
    return *known;
}

double ModelJudge::scheme_error(drive::Writing writing, const ModelSpec& spec) const {
    ModelSpec full = spec;
    full.writing = writing;
    const std::vector<double> output = full_memory(full, step_.input);
    double largest = 0.0;
    for (std::size_t k = 0; k < output.size(); ++k) {
        largest = std::max(largest, std::fabs(output[k] - step_.expected[k]));
    }
    return largest / step_.peak;
}

ModelErrors ModelJudge::errors_of(const ModelSpec& spec) const {
    return {error_of(spec, step_),
            error_of(spec, spec.writing == drive::Writing::delta ? random_delta_ : random_bdf2_)};
}

ModelChoice choose_model(const drive::Model& model, double step_s, double max_error, std::size_t samples,
                         std::optional<double> input_full_scale) {
    if (drive::zeros_right_of_axis(model.denominator) > 0) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             "expected a stable model, found one with poles right of the axis: glsum stability tells");
    }
    ModelSpec base{model, step_s, samples};
    base.input_full_scale = input_full_scale;
    const ModelJudge judge(model, step_s, samples);
    const double delta = judge.scheme_error(drive::Writing::delta, base);
    const auto all = candidates(base, delta <= max_error);
    std::optional<ModelChoice> nearest;
    base::Progress progress("lengths", all.size());
    for (const ModelSpec& spec : all) {
        ModelChoice choice{spec, {}, 0.0, 0.0};
        try {
            const SteppedModel stepped(spec);
            choice.loop_gain = stepped.design().loop_gain();
            choice.spec.memory = stepped.design().memory();  // what is 0 is left out
            choice.errors = judge.errors_of(spec);
        } catch (const glsum::Failure&) {
            progress.advance();
            continue;  // too short to be stable
        }
        const double worst = std::max(choice.errors.step, choice.errors.random);
        if (worst <= max_error) {
            choice.scheme = spec.writing == drive::Writing::delta ? delta : judge.scheme_error(spec.writing, spec);
            return choice;
        }
        if (std::isfinite(worst) && (!nearest || worst < std::max(nearest->errors.step, nearest->errors.random))) {
            nearest = choice;
        }
        progress.advance();
    }
    throw glsum::Failure(
        glsum::Exit::check_failed,
        nearest ? fmt::format("--max-error: expected {} to be kept; the nearest, {} with {}, errs {:.2g}", max_error,
                              drive::realtime_name(nearest->spec.kernel(), nearest->spec.writing),
                              nearest->spec.memory.text(), std::max(nearest->errors.step, nearest->errors.random))
                : fmt::format("--step-s: no length steps the model at {} s without running away", step_s));
}

}  // namespace generate
