#include "gap/drive/simulate.hpp"

#include <algorithm>
#include <cmath>

namespace gap {
namespace {

// The held input a dead time later: intervals that straddle are mixed.
std::vector<double> delayed(std::span<const double> held, double intervals) {
    std::vector<double> later(held.size(), 0.0);
    const auto whole = static_cast<std::size_t>(intervals);
    const double part = intervals - static_cast<double>(whole);
    for (std::size_t k = whole; k < held.size(); ++k) {
        later[k] = (1.0 - part) * held[k - whole] + (k > whole ? part * held[k - whole - 1] : 0.0);
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
    const std::vector<double> late = delayed(held, scenario.model.delay_s / grid.step_s);
    std::vector<double> nodes(grid.count);
    for (std::size_t k = 0; k < grid.count; ++k) {
        nodes[k] = 0.5 * (late[k] + (k > 0 ? late[k - 1] : 0.0));
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
        forcing[k] = scenario.model.gain * value;
    }
    for (const Push& push : scenario.forces.pushes) {
        for (std::size_t k = 0; k < grid.count; ++k) {
            // The share of [t - h/2, t + h/2] that it acts.
            const double from = std::max(push.from_s, grid.at(k) - 0.5 * grid.step_s);
            const double to = std::min(push.to_s, grid.at(k) + 0.5 * grid.step_s);
            forcing[k] += push.size * std::max(0.0, to - from) / grid.step_s;
        }
    }
    return forcing;
}

// The increment e for which stiffness-like terms, drag and friction balance `drive`:
//   drive - mass e - a_0 restoring(y + e) - drag e |e| / h^2 - friction sign(e) = 0.
class Balance {
public:
    Balance(const Forces& forces, double mass, double constant, double step_s)
        : forces_(forces), mass_(mass), constant_(constant), drag_(forces.drag / (step_s * step_s)) {}

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
        if (forces_.angle_per_unit == 0.0 && drag_ == 0.0) {
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
        const double kappa = forces_.angle_per_unit;
        return kappa == 0.0 ? y : std::sin(kappa * y) / kappa;
    }
    [[nodiscard]] double slope(double y) const {
        const double kappa = forces_.angle_per_unit;
        return kappa == 0.0 ? 1.0 : std::cos(kappa * y);
    }

    const Forces& forces_;
    double mass_;
    double constant_;
    double drag_;
};

}  // namespace

Course::Course(const Record& record, unsigned per_interval)
    : record_(&record), grid_(record.grid(per_interval)), held_(held_on(grid_, record)), exponentials_(grid_.count) {}

std::vector<double> move(const Scenario& scenario, const Course& course, std::vector<double>& effective_input) {
    const Grid& grid = course.grid();
    effective_input = course.held();
    for (const InputStage& stage : scenario.input) {
        stage(effective_input, grid);
    }
    const std::vector<double> forcing = forcing_of(scenario, course, effective_input);
    const Side below = side_of(scenario.model.denominator, course.exponentials(), grid.step_s);
    Past past(course.exponentials(), below.table);
    past.fill_near(scenario.initial_velocity * grid.step_s);
    const Balance balance(scenario.forces, past.newest(), below.constant, grid.step_s);
    std::vector<double> y(grid.count);
    y[0] = scenario.initial_output;
    for (std::size_t k = 1; k < grid.count; ++k) {
        double e = balance.increment(forcing[k] - past.known(), y[k - 1]);
        double remembered = e;
        if (scenario.forces.stop && y[k - 1] + e > scenario.forces.stop->limit) {
            e = scenario.forces.stop->limit - y[k - 1];
            remembered = -scenario.forces.stop->restitution * remembered;
        }
        past.push(remembered);
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
    const std::vector<double> y = z;
    for (const OutputStage& stage : scenario.output) {
        stage(z, {course.grid(), input, y});
    }
    std::vector<double> reading = read_at(course.grid(), z, course.record().time_s);
    for (double& value : reading) {
        value += scenario.offset;
    }
    for (const LoggerStage& stage : scenario.logger) {
        stage(reading, course.record());
    }
    return reading;
}

Course make_course(const Record& record, const Scenario& scenario, double allowed) {
    for (unsigned per_interval = 1; per_interval < 8; per_interval *= 2) {
        const std::vector<double> coarse = simulate(scenario, Course(record, per_interval));
        const std::vector<double> fine = simulate(scenario, Course(record, 2 * per_interval));
        double sum = 0.0;
        for (std::size_t i = 0; i < fine.size(); ++i) {
            sum += (fine[i] - coarse[i]) * (fine[i] - coarse[i]);
        }
        // Second order: what is left at the coarse step is 4/3 of the difference.
        if (std::sqrt(sum / static_cast<double>(fine.size())) * 4.0 / 3.0 <= allowed) {
            return Course(record, per_interval);
        }
    }
    return Course(record, 8);
}

}  // namespace gap
