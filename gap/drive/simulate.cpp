#include "gap/drive/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/failure.hpp"
#include "drive/simulation.hpp"
#include "gap/drive/balance.hpp"

namespace gap {
namespace {

// The held input a dead time later: intervals that straddle are mixed.
std::vector<double> delayed(std::span<const double> held, double intervals, double before) {
    std::vector<double> later(held.size(), before);
    const auto whole = static_cast<std::size_t>(std::min(intervals, static_cast<double>(held.size())));
    const double part = intervals - static_cast<double>(whole);
    for (std::size_t k = whole; k < held.size(); ++k) {
        later[k] = (1.0 - part) * held[k - whole] + part * (k > whole ? held[k - whole - 1] : before);
    }
    return later;
}

// The side of one polynomial: its derivatives as one table, its constant apart.
struct Side {
    Table table;
    double constant = 0.0;
    bool dynamic = false;
};

Side side_of(const std::vector<drive::Term>& terms, const Exponentials& exponentials, double step_s) {
    Side side;
    side.table.near = Eigen::VectorXd::Zero(Exponentials::near_count);
    side.table.far = Eigen::VectorXd::Zero(exponentials.ratios().size());
    for (const drive::Term& term : terms) {
        if (term.order == 0.0) {
            side.constant += term.coefficient;
            continue;
        }
        const Table table = exponentials.table(term.order);
        const double scale = term.coefficient * std::pow(step_s, -term.order);
        side.table.near += scale * table.near;
        side.table.far += scale * table.far;
        side.dynamic = true;
    }
    return side;
}

struct Forcing {
    std::vector<double> nodes;
    double before;      // the record
    double blow = 0.0;  // of the input's derivatives, at node 0, which has it not
};

// Of the input at the nodes, but for what it does at node 0, which is the result.
template <class Past>
double add_derivatives(std::vector<double>& to, std::span<const double> nodes, double before, Past& past) {
    double at_once = 0.0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const double increment = nodes[k] - before;
        const double newest = past.newest() * increment;
        to[k] += past.known() + (k == 0 ? 0.0 : newest);
        at_once += k == 0 ? newest : 0.0;
        past.push(increment);
        before = nodes[k];
    }
    return at_once;
}

// What drives the model at each node, its gain and numerator included: the mean of the intervals on both sides of a
// node, so that a jump at a node counts half there.
// \param before_record  the effective input there
Forcing forcing_of(const Scenario& scenario, const Course& course, std::span<const double> held, double before_record) {
    const Grid& grid = course.grid();
    const std::vector<double> late = delayed(held, scenario.model.delay_s / grid.step_s, before_record);
    std::vector<double> nodes(grid.count);
    for (std::size_t k = 0; k < grid.count; ++k) {
        nodes[k] = 0.5 * (late[k] + (k > 0 ? late[k - 1] : before_record));
    }
    const Side above = side_of(scenario.model.numerator, course.exponentials(), grid.step_s);
    Forcing forcing{std::vector<double>(grid.count),
                    scenario.model.gain * above.constant * before_record + scenario.forces.bias};
    for (std::size_t k = 0; k < grid.count; ++k) {
        forcing.nodes[k] = above.constant * nodes[k];
    }
    if (above.dynamic) {
        forcing.blow = with_past(course.exponentials(), above.table, [&](auto past) {
            return scenario.model.gain * add_derivatives(forcing.nodes, nodes, before_record, past);
        });
    }
    for (double& node : forcing.nodes) {
        node = scenario.model.gain * node + scenario.forces.bias;
    }
    for (const Push& push : scenario.forces.pushes) {
        for (std::size_t k = 0; k < grid.count; ++k) {
            // The share of [t - h/2, t + h/2] that it acts.
            const double at_s = static_cast<double>(k) * grid.step_s;
            const double from = std::max(push.from_s, at_s - 0.5 * grid.step_s);
            const double to = std::min(push.to_s, at_s + 0.5 * grid.step_s);
            forcing.nodes[k] += push.size * std::max(0.0, to - from) / grid.step_s;
        }
    }
    return forcing;
}

// The output at each node.
template <class Past>
std::vector<double> outputs(const Scenario& scenario, const Grid& grid, Forcing& forcing, double constant, Past& past) {
    // As it came, it goes on evenly, until at node 0 forces begin that are not those that let it come. Of a jump at a
    // node half counts there; the output at node 0 is given, so that node 1 has it. A blow moves it from there on.
    const double even = scenario.initial_velocity * grid.step_s;
    Balance balance(scenario, past.newest(), constant, grid.step_s);
    past.fill_near(even);
    std::vector<double> y(grid.count);
    y[0] = scenario.initial_output;
    const double after = 2.0 * forcing.nodes[0] - forcing.before;
    forcing.nodes[1] += 0.5 * balance.unbalanced(after, past.known() + past.newest() * even, y[0], even);
    double at = y[0];
    if (forcing.blow != 0.0) {
        const double moved = forcing.blow / (past.newest() + constant);
        past.push(even + moved);
        at += moved;
    }
    constexpr double runs_away = 1e12;
    const std::optional<EndStop>& stop = scenario.forces.stop;
    const double limit = stop ? stop->limit - scenario.operating_output : std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < grid.count; ++k) {
        double e = balance.increment(forcing.nodes[k], past.known(), at);
        const bool stopped = at + e > limit;
        if (stopped) {
            const double back = -stop->restitution * e;
            past.push(back);
            past.fill_near(back);  // a blow: nothing of the speed before it is left
            e = limit - at;
        } else {
            past.push(e);
        }
        balance.advance(at, e);
        at += e;
        y[k] = at;
        if (!(std::fabs(at) <= runs_away)) {
            std::fill(y.begin() + static_cast<std::ptrdiff_t>(k), y.end(), std::nan(""));
            break;
        }
    }
    return y;
}

// Further inputs, each behind a lag of its own that rests at the record's first level. What they were before it.
double add_more_inputs(const Scenario& scenario, const Course& course, std::span<double> effective_input) {
    double before = 0.0;
    for (const FurtherInput& further : scenario.further_inputs) {
        if (further.number >= course.more_held().size()) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("{}: expected {} inputs, found {}", course.record().name,
                                             further.number + 2, course.more_held().size() + 1));
        }
        const std::vector<double>& held = course.more_held()[further.number];
        const double intervals = further.tau_s > 0.0 ? course.grid().step_s / further.tau_s : 0.0;
        const double left = std::exp(-intervals);
        const double mean_left = intervals > 0.0 ? -std::expm1(-intervals) / intervals : 0.0;
        double at = held.front();
        before += further.gain * at;
        for (std::size_t k = 0; k < effective_input.size(); ++k) {
            effective_input[k] += further.gain * (held[k] + (at - held[k]) * mean_left);
            at = intervals > 0.0 ? held[k] + (at - held[k]) * left : held[k];
        }
    }
    return before;
}

// What the simulation that ran shows beyond the model: both read at the stamps.
void add_deployed_error(std::span<double> reading, const Scenario& scenario, const Course& course) {
    const Deployed& deployed = *scenario.deployed;
    const double below = deployed.taps > 0.0 ? std::max(2.0, std::floor(deployed.taps)) : 0.0;
    std::vector<double> ran = course.deployed(scenario.model, deployed, static_cast<std::size_t>(below));
    if (deployed.taps > below) {
        const std::vector<double> longer =
            course.deployed(scenario.model, deployed, static_cast<std::size_t>(below) + 1);
        for (std::size_t i = 0; i < ran.size(); ++i) {
            ran[i] += (deployed.taps - below) * (longer[i] - ran[i]);
        }
    }
    Scenario plain;
    plain.model = scenario.model;
    const std::vector<double> ideal = simulate(plain, course);
    for (std::size_t i = 0; i < reading.size(); ++i) {
        reading[i] += ran[i] - ideal[i];
    }
}

std::vector<double> run_deployed(const Record& record, const drive::Model& model, const Deployed& deployed,
                                 std::size_t taps) {
    const double length_s = record.time_s.back() - record.time_s.front();
    const double step_s =
        deployed.step_s > 0.0 ? deployed.step_s : model.sample_time_s.value_or(record.usual_interval_s);
    Grid steps{record.time_s.front(), step_s, static_cast<std::size_t>(std::floor(length_s / step_s + 1e-6)) + 2};
    std::vector<double> input(steps.count);
    std::size_t sample = 0;
    for (std::size_t k = 0; k < steps.count; ++k) {
        while (sample + 1 < record.size() && record.time_s[sample + 1] <= steps.at(k) + 1e-6 * steps.step_s) {
            ++sample;
        }
        input[k] = record.input[sample];
    }
    drive::Scheme scheme;
    scheme.step_s = step_s;
    scheme.kernel = deployed.kernel;
    scheme.increments = deployed.increments;
    if (taps > 0) {
        scheme.taps = taps;
    }
    return read_at(steps, drive::simulate(model, scheme, input).output, record.time_s);
}

double rms(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value * value;
    }
    return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

Course::Course(const Record& record, double per_interval)
    : record_(&record),
      grid_(record.grid(per_interval)),
      held_(held_on(grid_, record.time_s, record.input)),
      exponentials_(grid_.count),
      correction_(record.size(), 0.0) {
    for (const std::vector<double>& levels : record.more_inputs) {
        more_held_.push_back(held_on(grid_, record.time_s, levels));
    }
    std::vector<double> places(grid_.count);
    for (std::size_t k = 0; k < places.size(); ++k) {
        places[k] = static_cast<double>(k);
    }
    for (const double place : read_at(grid_, places, record.time_s)) {
        below_.push_back(std::min(static_cast<std::size_t>(place), grid_.count - 2));
        share_.push_back(place - static_cast<double>(below_.back()));
    }
}

std::vector<double> Course::read(std::span<const double> nodes) const {
    std::vector<double> reading(below_.size());
    for (std::size_t i = 0; i < reading.size(); ++i) {
        const double from = nodes[below_[i]];
        reading[i] = from + share_[i] * (nodes[below_[i] + 1] - from);
    }
    return reading;
}

std::vector<double> Course::nodes_of(const Scenario& scenario) const {
    std::vector<double> input;
    return move(scenario, *this, input);
}

void Course::correct(std::vector<double> correction) { correction_ = std::move(correction); }

std::vector<double> Course::deployed(const drive::Model& model, const Deployed& deployed, std::size_t taps) const {
    constexpr std::size_t most_kept = 64;
    std::vector<double> key{deployed.step_s,
                            model.sample_time_s.value_or(0.0),
                            deployed.increments ? 1.0 : 0.0,
                            static_cast<double>(taps),
                            model.gain,
                            model.delay_s};
    for (const char letter : deployed.kernel) {
        key.push_back(static_cast<double>(letter));
    }
    for (const auto* terms : {&model.numerator, &model.denominator}) {
        for (const drive::Term& term : *terms) {
            key.push_back(term.coefficient);
            key.push_back(term.order);
        }
        key.push_back(-1.0);
    }
    {
        const std::lock_guard lock(known_->mutex);
        if (const auto found = known_->readings.find(key); found != known_->readings.end()) {
            return found->second;
        }
    }
    std::vector<double> reading = run_deployed(*record_, model, deployed, taps);
    const std::lock_guard lock(known_->mutex);
    if (known_->readings.size() >= most_kept) {
        known_->readings.clear();
    }
    return known_->readings.emplace(std::move(key), std::move(reading)).first->second;
}

std::vector<double> move(const Scenario& scenario, const Course& course, std::vector<double>& effective_input) {
    const Grid& grid = course.grid();
    if (scenario.levels.empty()) {
        effective_input = course.held();
    } else {
        std::vector<double> levels = course.record().input;
        for (const LevelStage& stage : scenario.levels) {
            stage(levels);
        }
        effective_input = held_on(grid, course.record().time_s, levels);
    }
    for (const InputStage& stage : scenario.input) {
        stage(effective_input, grid);
    }
    const double more_before = add_more_inputs(scenario, course, effective_input);
    Forcing forcing = forcing_of(scenario, course, effective_input, scenario.input_before + more_before);
    const Side below = side_of(scenario.model.denominator, course.exponentials(), grid.step_s);
    return with_past(course.exponentials(), below.table,
                     [&](auto past) { return outputs(scenario, grid, forcing, below.constant, past); });
}

std::vector<double> simulate(const Scenario& scenario, const Course& course) {
    std::vector<double> input;
    std::vector<double> z = move(scenario, course, input);
    for (double& value : z) {
        value += scenario.operating_output;
    }
    if (!scenario.output.empty()) {
        const std::vector<double> y = z;
        for (const OutputStage& stage : scenario.output) {
            stage(z, {course.grid(), input, y});
        }
    }
    std::vector<double> reading = course.read(z);
    for (std::size_t i = 0; i < reading.size(); ++i) {
        reading[i] += course.correction()[i];
    }
    if (scenario.deployed) {
        add_deployed_error(reading, scenario, course);
    }
    for (const LoggerStage& stage : scenario.logger) {
        stage(reading, course.record());
    }
    return reading;
}

Course make_course(const Record& record, const Scenario& scenario, double allowed) {
    constexpr double finest = 8;
    std::vector<double> coarse = simulate(scenario, Course(record, 1));
    for (double per_interval = 1;; per_interval *= 2) {
        const std::vector<double> fine = simulate(scenario, Course(record, 2 * per_interval));
        // Second order in the step: the limit lies a third of the last difference beyond.
        std::vector<double> off(record.size());
        for (std::size_t i = 0; i < off.size(); ++i) {
            off[i] = (fine[i] - coarse[i]) * 4.0 / 3.0;
        }
        if (per_interval == finest || !(rms(off) > allowed)) {
            Course course(record, per_interval);
            if (std::isfinite(rms(off))) {
                course.correct(std::move(off));
            }
            return course;
        }
        coarse = fine;
    }
}

Course make_sketch(const Course& fine, const Record& thin, std::size_t every, const Scenario& scenario,
                   double allowed) {
    // A node for each reading is enough, unless it shows another swing: what is added to it stays, while the fit moves
    // on.
    constexpr double another_swing = 0.05;
    const std::vector<double> wanted = simulate(scenario, fine);
    const double finest = static_cast<double>(every) * fine.record().usual_interval_s / fine.grid().step_s;
    for (double per_interval = 0.25;; per_interval *= 2) {
        Course course(thin, per_interval);
        std::vector<double> off = simulate(scenario, course);
        for (std::size_t i = 0; i < off.size(); ++i) {
            off[i] = wanted[i * every] - off[i];
        }
        const double enough = rms(off) > another_swing * rms(wanted) ? finest : static_cast<double>(every);
        if (per_interval >= enough || rms(off) <= allowed) {
            if (std::isfinite(rms(off))) {
                course.correct(std::move(off));
            }
            return course;
        }
    }
}

}  // namespace gap
