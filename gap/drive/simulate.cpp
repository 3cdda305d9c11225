#include "gap/drive/simulate.hpp"

#include <algorithm>
#include <cmath>

#include "drive/simulation.hpp"

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

// What drives the model at each node, its gain and numerator included: the mean of the intervals on both sides of a
// node, so that a jump at a node counts half there.
std::vector<double> forcing_of(const Scenario& scenario, const Course& course, std::span<const double> held) {
    const Grid& grid = course.grid();
    const std::vector<double> late = delayed(held, scenario.model.delay_s / grid.step_s, scenario.input_before);
    std::vector<double> nodes(grid.count);
    for (std::size_t k = 0; k < grid.count; ++k) {
        nodes[k] = 0.5 * (late[k] + (k > 0 ? late[k - 1] : scenario.input_before));
    }
    const Side above = side_of(scenario.model.numerator, course.exponentials(), grid.step_s);
    std::vector<double> forcing(grid.count);
    Past past(course.exponentials(), above.table);
    double before = 0.0;
    for (std::size_t k = 0; k < grid.count; ++k) {
        double value = above.constant * nodes[k];
        if (above.dynamic) {
            const double increment = nodes[k] - before;
            value += past.newest() * increment + past.known();
            past.push(increment);
            before = nodes[k];
        }
        forcing[k] = scenario.model.gain * value + scenario.forces.bias;
    }
    for (const Push& push : scenario.forces.pushes) {
        for (std::size_t k = 0; k < grid.count; ++k) {
            // The share of [t - h/2, t + h/2] that it acts.
            const double at_s = static_cast<double>(k) * grid.step_s;
            const double from = std::max(push.from_s, at_s - 0.5 * grid.step_s);
            const double to = std::min(push.to_s, at_s + 0.5 * grid.step_s);
            forcing[k] += push.size * std::max(0.0, to - from) / grid.step_s;
        }
    }
    return forcing;
}

// The increment e for which stiffness-like terms, drag and friction balance `drive`:
//   drive - mass e - a_0 restoring(y + e) - drag e |e| / h^2 - friction sign(e) = 0.
class Balance {
public:
    Balance(const Scenario& scenario, double mass, double constant, double step_s)
        : forces_(scenario.forces),
          operating_(scenario.operating_output),
          mass_(mass),
          constant_(constant),
          drag_(scenario.forces.drag / (step_s * step_s)),
          linear_(forces_.angle_per_unit == 0.0 && !forces_.outflow && drag_ == 0.0) {}

    [[nodiscard]] double increment(double drive, double y) const {
        const double net = drive - constant_ * restoring(y);
        double left = net;
        if (forces_.friction_up != 0.0 || forces_.friction_down != 0.0) {
            if (net > forces_.friction_up) {
                left = net - forces_.friction_up;
            } else if (net < -forces_.friction_down) {
                left = net + forces_.friction_down;
            } else {
                return 0.0;
            }
        }
        double e = left / (mass_ + constant_ * slope(y));
        if (linear_) {
            return e;
        }
        for (int i = 0; i < 8; ++i) {  // Newton: both are smooth, and e is small
            const double miss =
                mass_ * e + constant_ * (restoring(y + e) - restoring(y)) + drag_ * e * std::fabs(e) - left;
            const double by = miss / (mass_ + constant_ * slope(y + e) + 2.0 * drag_ * std::fabs(e));
            e -= by;
            if (std::fabs(by) <= 1e-12 * (std::fabs(e) + 1e-300)) {
                break;
            }
        }
        return e;
    }

private:
    [[nodiscard]] double restoring(double y) const {
        if (forces_.outflow) {
            return bent(y + operating_) - bent(operating_);
        }
        const double kappa = forces_.angle_per_unit;
        return kappa == 0.0 ? y : std::sin(kappa * y) / kappa;
    }
    [[nodiscard]] double slope(double y) const {
        if (forces_.outflow) {
            const double c = forces_.outflow->curvature;
            return (1.0 - c) + 2.0 * c * std::fabs(y + operating_) / forces_.outflow->reference;
        }
        const double kappa = forces_.angle_per_unit;
        return kappa == 0.0 ? 1.0 : std::cos(kappa * y);
    }
    [[nodiscard]] double bent(double level) const {
        const double c = forces_.outflow->curvature;
        return level * ((1.0 - c) + c * std::fabs(level) / forces_.outflow->reference);
    }

    const Forces& forces_;
    double operating_;
    double mass_;
    double constant_;
    double drag_;
    bool linear_;
};

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
    const std::vector<double> forcing = forcing_of(scenario, course, effective_input);
    const Side below = side_of(scenario.model.denominator, course.exponentials(), grid.step_s);
    Past past(course.exponentials(), below.table);
    past.fill_near(scenario.initial_velocity * grid.step_s);
    const Balance balance(scenario, past.newest(), below.constant, grid.step_s);
    std::vector<double> y(grid.count);
    y[0] = scenario.initial_output;
    for (std::size_t k = 1; k < grid.count; ++k) {
        double e = balance.increment(forcing[k] - past.known(), y[k - 1]);
        double remembered = e;
        const bool stopped =
            scenario.forces.stop && y[k - 1] + e > scenario.forces.stop->limit - scenario.operating_output;
        if (stopped) {
            e = scenario.forces.stop->limit - scenario.operating_output - y[k - 1];
            remembered = -scenario.forces.stop->restitution * remembered;
        }
        past.push(remembered);
        if (stopped) {
            past.fill_near(remembered);  // a blow: nothing of the speed before it is left
        }
        y[k] = y[k - 1] + e;
        if (!std::isfinite(y[k]) || std::fabs(y[k]) > 1e12) {
            std::fill(y.begin() + static_cast<std::ptrdiff_t>(k), y.end(), std::nan(""));
            break;
        }
    }
    return y;
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
    const std::vector<double> wanted = simulate(scenario, fine);
    for (double per_interval = 0.25;; per_interval *= 2) {
        Course course(thin, per_interval);
        std::vector<double> off = simulate(scenario, course);
        for (std::size_t i = 0; i < off.size(); ++i) {
            off[i] = wanted[i * every] - off[i];
        }
        if (per_interval >= static_cast<double>(every) || rms(off) <= allowed) {
            if (std::isfinite(rms(off))) {
                course.correct(std::move(off));
            }
            return course;
        }
    }
}

}  // namespace gap
