#include "drive/realtime_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "glsum/design/merged.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

// C as terms of increments: an order v is v + 1 there, and h^-(v+1) too large by 1/h.
std::vector<glsum::design::Term> terms_of(const FractionalPid& gains, double step_s) {
    std::vector<glsum::design::Term> terms;
    for (const auto& [gain, order] : {std::pair(gains.kp, 0.0), std::pair(gains.ki, -gains.integral_order),
                                      std::pair(gains.kd, gains.derivative_order)}) {
        if (gain != 0.0) {
            terms.push_back({gain * step_s, order + 1.0});
        }
    }
    return terms;
}

// A controller or a model with buffers of its own.
template <template <class> class Stepped, class K>
struct Buffered {
    typename Stepped<K>::State state{};
    std::vector<typename K::Coefficient> table;
    std::vector<typename K::Sample> past;
    std::vector<typename K::Sample> delay;
};

}  // namespace

RealtimeController::RealtimeController(const FractionalPid& gains, const Memory& memory, double step_s,
                                       std::size_t horizon) {
    if (gains.kp == 0.0 && gains.ki == 0.0 && gains.kd == 0.0) {
        refuse("expected kp, ki or kd other than 0");
    }
    const auto in_range = [](double order) { return order > 0.0 && order <= 1.0; };
    if (!in_range(gains.integral_order) || !in_range(gains.derivative_order)) {
        refuse(fmt::format("expected an integral and a derivative order above 0 and at most 1, found {} and {}",
                           gains.integral_order, gains.derivative_order));
    }
    if (!(step_s > 0.0 && std::isfinite(step_s))) {
        refuse(fmt::format("expected a step above 0 s, found {}", step_s));
    }
    const std::size_t near_taps = memory.taps - std::min(2 * memory.modes, memory.taps);
    if (near_taps < 3) {
        refuse(fmt::format("expected at least 3 taps before the modes, found {}", memory.text()));
    }
    // p_0, p_1, ... of the position; the velocity's are their differences. What stands for the tail of p is then what
    // stands for u: its error is not summed up.
    const std::size_t last = std::max(horizon, near_taps);
    const std::vector<glsum::design::Term> terms = terms_of(gains, step_s);
    constexpr auto scheme = glsum::design::Discretisation::grunwald_letnikov;
    const std::vector<double> position = glsum::design::merged_weights(terms, step_s, scheme, last);
    std::vector<double> velocity = {position[0]};
    for (std::size_t j = 1; j < near_taps; ++j) {
        velocity.push_back(position[j] - position[j - 1]);
    }
    if (memory.modes > 0) {
        auto found = glsum::design::approximate_merged(terms, step_s, scheme, last, near_taps - 1, memory.modes);
        modes_ = std::move(found.modes);
        error_ = found.error;
    }
    if (modes_.empty()) {
        for (std::size_t j = near_taps; j <= last; ++j) {
            error_ += std::fabs(position[j] - position[near_taps - 1]);
        }
    } else {
        velocity.back() = -position[near_taps - 2];
        for (glsum::Mode& mode : modes_) {
            velocity.back() += mode.weight;
            mode.weight *= -mode.decay;
        }
    }
    for (std::size_t j = 1; j < near_taps; ++j) {
        ratios_.push_back(velocity[j] / velocity[0]);
    }
    for (glsum::Mode& mode : modes_) {
        mode.weight /= velocity[0];
    }
    memory_ = {near_taps + 2 * modes_.size(), modes_.size()};
    design_.first = velocity[0];
    design_.ratios = ratios_;
    design_.modes = modes_;
}

double loop_gain(const RealtimeController& controller, const FractionalPid& gains, const Model& plant, double step_s,
                 std::size_t horizon) {
    using K = glsum::Sum<glsum::Ring, glsum::Oldest, glsum::F64>;
    const RealtimeController exact(gains, {horizon}, step_s, horizon);
    Model sooner = plant;  // a step returns the output before the sample that it is given acts: one of its delay
    sooner.delay_s = std::max(0.0, plant.delay_s - step_s);
    const RealtimeModel model(sooner, Writing::delta, {horizon}, step_s);
    Buffered<glsum::Controller, K> one;
    one.table.resize(K::table_count(horizon));
    one.past.resize(K::past_count(horizon));
    Buffered<glsum::Stepper, K> other;
    other.table.resize(K::table_count(horizon));
    other.past.resize(K::past_count(horizon));
    other.delay.resize(glsum::Stepper<K>::line_count(model.design().delay));
    if (glsum::Controller<K>::prepare(one.state, exact.design(), one.table, one.past) != glsum::Status::ok ||
        glsum::Stepper<K>::prepare(other.state, model.design(), other.table, other.past, other.delay) !=
            glsum::Status::ok) {
        refuse("expected a controller and a model that double precision holds");
    }
    double sum = 0.0;
    double output = 0.0;
    for (std::size_t k = 0; k < horizon; ++k) {
        const double u = glsum::Controller<K>::step(one.state, -output) + (k == 0 ? 1.0 : 0.0);
        output = glsum::Stepper<K>::step(other.state, u);
        sum += std::fabs(output);
    }
    return controller.error() * sum;
}

}  // namespace drive
