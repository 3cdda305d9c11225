// What a simulation with effects is made of, where each part has a closed form: a plant without any dynamics gives back
// what drives it, node for node.
#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/failure.hpp"
#include "drive/simulation.hpp"
#include "gap/drive/simulate.hpp"

namespace {

using Values = std::vector<double>;

constexpr double h = 0.5;

gap::Record record_of(const Values& input) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = h;
    record.input = input;
    record.output.assign(input.size(), 0.0);
    for (std::size_t i = 0; i < input.size(); ++i) {
        record.time_s.push_back(20.0 + h * static_cast<double>(i));
    }
    return record;
}

gap::Record waves(std::size_t count) {
    Values input;
    for (std::size_t i = 0; i < count; ++i) {
        input.push_back(1.0 + std::sin(0.7 * static_cast<double>(i)));
    }
    return record_of(input);
}

gap::Scenario without_dynamics(double gain) {
    gap::Scenario scenario;
    scenario.model.gain = gain;
    scenario.model.denominator = {{1.0, 0.0}};
    return scenario;
}

double rms(const Values& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value * value;
    }
    return std::sqrt(sum / static_cast<double>(values.size()));
}

Values less(Values a, const Values& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        a[i] -= b[i];
    }
    return a;
}

void expect_near(const Values& found, const Values& wanted, std::size_t from = 0, double within = 1e-12) {
    ASSERT_GE(found.size(), wanted.size());
    for (std::size_t i = from; i < wanted.size(); ++i) {
        EXPECT_NEAR(found[i], wanted[i], within) << i;
    }
}

// The first two nodes meet what was before the record; from then on a node has the mean of both sides.
TEST(Forcing, IsTheMeanOfBothSidesOfANode) {
    const gap::Record record = record_of({1.0, 3.0, 3.0, 7.0, 0.0, 2.0, 5.0});
    gap::Scenario scenario = without_dynamics(2.0);
    scenario.forces.bias = 0.25;
    const gap::Course course(record, 1);
    expect_near(course.nodes_of(scenario), {0.0, 0.0, 6.25, 10.25, 7.25, 2.25, 7.25}, 2);
    // Late by an interval and a quarter: three quarters of the one before, a quarter of the one before that.
    scenario.model.delay_s = 1.25 * h;
    const Values late{9.0, 0.75 * 1.0 + 0.25 * 9.0, 0.75 * 3.0 + 0.25 * 1.0, 3.0, 0.75 * 7.0 + 0.25 * 3.0, 0.25 * 7.0};
    scenario.input_before = 9.0;
    Values wanted(2, 0.0);
    for (std::size_t k = 2; k < late.size(); ++k) {
        wanted.push_back(late[k] + late[k - 1] + 0.25);
    }
    expect_near(course.nodes_of(scenario), wanted, 2);
    // Later than the whole record nothing comes but what was before it.
    scenario.model.delay_s = 100.0;
    expect_near(course.nodes_of(scenario), Values(7, 18.25), 2);
}

// Half of a jump at a node counts there; the output at node 0 is given, so that node 1 has what is left of its.
TEST(Forcing, AtTheFirstNodeCountsAtTheSecond) {
    const gap::Course course(record_of(Values(8, 3.0)), 1);
    gap::Scenario lag;
    lag.model.gain = 2.0;
    lag.model.denominator = {{5.0, 1.0}, {1.0, 0.0}};
    lag.initial_output = 1.0;
    lag.input_before = 0.5;
    // By node 1: (newest / h 5 + 1) e = f(1) + half of what nothing balances at 0 - known - y.
    const double newest = 5.0 / h * 1.5;
    const double unbalanced = 2.0 * 3.0 - 1.0;
    const double e = (6.0 + 0.5 * unbalanced - 1.0) / (newest + 1.0);
    EXPECT_NEAR(course.nodes_of(lag)[1], 1.0 + e, 1e-12);
}

// D of a ramp is its slope, of a parabola a line.
TEST(Forcing, HasTheNumeratorsDerivatives) {
    Values ramp;
    for (int i = 0; i < 30; ++i) {
        ramp.push_back(0.3 * i);
    }
    gap::Scenario scenario = without_dynamics(2.0);
    scenario.model.numerator = {{0.7, 1.0}, {1.5, 0.0}};
    const gap::Course course(record_of(ramp), 1);
    const Values nodes = course.nodes_of(scenario);
    for (std::size_t k = 6; k < 30; ++k) {
        const double u = 0.3 * (static_cast<double>(k) - 0.5);
        EXPECT_NEAR(nodes[k], 2.0 * (0.7 * 0.3 / h + 1.5 * u), 1e-9) << k;
    }
}

// Of a plant whose numerator is as high as its denominator a jump of the input is one of the output, from the first
// node on: half the step, a quarter of the error.
TEST(Forcing, OfAJumpAtTheStartMovesTheOutputAtOnce) {
    const gap::Record record = record_of(Values(60, 3.0));
    gap::Scenario lead;
    lead.model.gain = 2.0;
    lead.model.numerator = {{4.0, 1.0}, {1.0, 0.0}};
    lead.model.denominator = {{5.0, 1.0}, {1.0, 0.0}};
    const auto off = [&](double per_interval) {
        const gap::Course course(record, per_interval);
        const Values reading = gap::simulate(lead, course);
        double largest = 0.0;
        for (std::size_t i = 2; i < record.size(); ++i) {
            const double wanted = 6.0 * (1.0 - 0.2 * std::exp(-(record.time_s[i] - 20.0) / 5.0));
            largest = std::max(largest, std::fabs(reading[i] - wanted));
        }
        return largest;
    };
    EXPECT_LT(off(8.0), 3e-4);
    EXPECT_NEAR(off(4.0) / off(8.0), 4.0, 0.2);
}

// A push acts on a node for its share of the interval about it.
TEST(Forcing, OfAPushIsItsShareOfTheInterval) {
    const gap::Course course(record_of(Values(12, 0.0)), 1);
    gap::Scenario scenario = without_dynamics(2.0);
    scenario.forces.pushes = {{1.6, 3.0, 8.0}, {4.0, 4.1, 5.0}};
    // Nodes at 0, 0.5, ..: the first from 1.6 to 3.0; 1.5 +- 0.25 has 0.15 of it, 3.0 +- 0.25 a half.
    expect_near(course.nodes_of(scenario), {0.0, 0.0, 0.0, 8.0 * 0.3, 8.0, 8.0, 4.0, 0.0, 5.0 * 0.2, 0.0}, 0);
}

// Each further input behind a lag of its own, which rests at what came first; of a level the mean over the interval.
TEST(Forcing, OfAFurtherInputIsLaggedAndAdded) {
    gap::Record record = record_of({1.0, 3.0, 3.0, 7.0, 0.0, 2.0, 5.0});
    record.more_inputs = {{0.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0}, {2.0, 2.0, 2.0, 6.0, 6.0, 6.0, 6.0}};
    const gap::Course course(record, 1);
    gap::Scenario scenario = without_dynamics(1.0);
    scenario.further_inputs = {{1, 0.5, 0.0}};
    expect_near(course.nodes_of(scenario), {0.0, 0.0, 3.0 + 1.0, 5.0 + 2.0, 3.5 + 3.0, 1.0 + 3.0, 3.5 + 3.0}, 2);
    scenario.further_inputs = {{0, 0.5, 0.8}};
    const double left = std::exp(-h / 0.8);
    const double mean_left = 0.8 / h * (1.0 - left);
    Values lagged{0.0};
    for (int k = 0; k < 7; ++k) {
        lagged.push_back(4.0 * (1.0 - std::pow(left, k) * mean_left));
    }
    Values wanted{0.0, 0.0, 3.0, 5.0, 3.5, 1.0, 3.5};
    for (std::size_t k = 2; k < wanted.size(); ++k) {
        wanted[k] += 0.5 * 0.5 * (lagged[k] + lagged[k - 1]);
    }
    expect_near(course.nodes_of(scenario), wanted, 2);
    // What both bring, and what they brought before the record is at rest.
    record.more_inputs = {Values(7, 4.0), Values(7, 2.0)};
    record.input.assign(7, 1.0);
    const gap::Course constant(record, 1);
    scenario.further_inputs = {{0, 0.5, 0.8}, {1, 0.25, 0.0}};
    scenario.input_before = 1.0;
    scenario.initial_output = 3.5;
    expect_near(constant.nodes_of(scenario), Values(7, 3.5));
    scenario.model.delay_s = 1.2;
    expect_near(constant.nodes_of(scenario), Values(7, 3.5));
    scenario.further_inputs = {{2, 1.0, 0.0}};
    try {
        (void)constant.nodes_of(scenario);
        FAIL() << "expected a failure";
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        EXPECT_STREQ(failure.what(), "made: expected 4 inputs, found 3");
    }
}

// A mass without friction meets a stop with a speed and leaves with a share of it; the stop is a reading.
TEST(Motion, LeavesAStopWithAShareOfItsSpeed) {
    const gap::Course course(record_of(Values(61, 0.0)), 4);
    gap::Scenario flight;
    flight.model.denominator = {{2.0, 2.0}};
    flight.initial_output = -1.0;
    flight.initial_velocity = 0.8;
    flight.operating_output = 3.0;
    flight.forces.stop = gap::EndStop{5.0, 0.25};
    const Values y = course.nodes_of(flight);
    const double step_s = h / 4.0;
    // From -1 to 2 at 0.8 a second: 3.75 s, which is node 30.
    for (std::size_t k = 0; k < 30; ++k) {
        EXPECT_NEAR(y[k], -1.0 + 0.8 * step_s * static_cast<double>(k), 1e-9) << k;
    }
    for (std::size_t k = 31; k < 150; ++k) {
        EXPECT_NEAR(y[k], 2.0 - 0.2 * step_s * static_cast<double>(k - 30), 0.2 * step_s + 1e-9) << k;
        EXPECT_NEAR(y[k] - y[k + 1], 0.2 * step_s, 1e-9) << k;
    }
    // Without restitution it stays.
    flight.forces.stop->restitution = 0.0;
    EXPECT_NEAR(course.nodes_of(flight).back(), 2.0, 1e-9);
}

// Beyond 10^12 a simulation has run away: nothing is said from there on.
TEST(Motion, ThatRunsAwayIsNoNumber) {
    const gap::Course course(record_of({0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0}), 1);
    EXPECT_NEAR(course.nodes_of(without_dynamics(0.995e12))[4], 0.995e12, 1.0);
    for (const double gain : {1.005e12, -1.005e12}) {
        const Values y = course.nodes_of(without_dynamics(gain));
        EXPECT_NEAR(y[3], 0.5 * gain, 1.0);
        for (std::size_t k = 4; k < y.size(); ++k) {
            EXPECT_TRUE(std::isnan(y[k])) << k;
        }
    }
}

// Stages in turn: levels, the input between nodes, the output at the operating point, the logger.
TEST(Simulation, PassesEachStageInTurn) {
    const gap::Record record = record_of({1.0, 3.0, 3.0, 7.0, 0.0, 2.0, 5.0});
    gap::Course course(record, 1);
    gap::Scenario scenario = without_dynamics(1.0);
    scenario.operating_output = 10.0;
    scenario.levels = {[](std::span<double> levels) {
                           for (double& level : levels) {
                               level += 1.0;
                           }
                       },
                       [](std::span<double> levels) {
                           for (double& level : levels) {
                               level *= 2.0;
                           }
                       }};
    scenario.input = {[](std::span<double> held, const gap::Grid& grid) {
        EXPECT_EQ(grid.step_s, h);
        for (double& u : held) {
            u *= 10.0;
        }
    }};
    Values seen;
    scenario.output = {[&](std::span<double> z, const gap::Motion& motion) {
                           EXPECT_EQ(motion.input[3], 160.0);
                           for (std::size_t k = 0; k < z.size(); ++k) {
                               EXPECT_EQ(z[k], motion.output[k]);
                               z[k] = -z[k];
                           }
                       },
                       [&](std::span<double> z, const gap::Motion& motion) {
                           for (std::size_t k = 0; k < z.size(); ++k) {
                               EXPECT_EQ(z[k], -motion.output[k]);  // as it moved, whatever was read of it before
                           }
                           seen.assign(z.begin(), z.end());
                       }};
    scenario.logger = {[&](std::span<double> reading, const gap::Record& of) {
        EXPECT_EQ(of.name, "made");
        for (double& one : reading) {
            one *= 3.0;
        }
    }};
    const Values reading = gap::simulate(scenario, course);
    EXPECT_NEAR(seen[3], -130.0, 1e-9);  // 10 + (80 + 160) / 2
    EXPECT_NEAR(reading[3], -390.0, 1e-9);
    // A correction is of the reading, and the logger has it.
    course.correct(Values(7, 0.5));
    EXPECT_NEAR(gap::simulate(scenario, course)[3], -388.5, 1e-9);
}

// --- Courses: as coarse as is allowed.

gap::Scenario swinging() {
    gap::Scenario scenario;
    scenario.model.denominator = {{1.5, 1.7}, {0.8, 0.9}, {1.0, 0.0}};
    return scenario;
}

// What steps of a course are off by: four thirds of the way to one of half the step.
Values off_by(const gap::Record& record, double per_interval) {
    Values off = less(gap::simulate(swinging(), gap::Course(record, 2.0 * per_interval)),
                      gap::simulate(swinging(), gap::Course(record, per_interval)));
    for (double& one : off) {
        one *= 4.0 / 3.0;
    }
    return off;
}

TEST(MadeCourse, IsTheCoarsestThatIsNearEnough) {
    const gap::Record record = waves(80);
    const auto nodes = [&](double per_interval) { return record.grid(per_interval).count; };
    for (const double per_interval : {1.0, 2.0, 4.0}) {
        const Values off = off_by(record, per_interval);
        const gap::Course near = gap::make_course(record, swinging(), 1.0001 * rms(off));
        EXPECT_EQ(near.grid().count, nodes(per_interval));
        expect_near(near.correction(), off, 0, 1e-15);
        EXPECT_EQ(gap::make_course(record, swinging(), 0.9999 * rms(off)).grid().count, nodes(2.0 * per_interval));
    }
    // Eight nodes to the interval at most, and as far off as sixteen say.
    const gap::Course finest = gap::make_course(record, swinging(), 0.0);
    EXPECT_EQ(finest.grid().count, nodes(8.0));
    expect_near(finest.correction(), off_by(record, 8.0), 0, 1e-15);
    // What runs away is corrected by nothing.
    gap::Scenario away = swinging();
    away.model.gain = 1e13;
    const gap::Course lost = gap::make_course(record, away, 0.1);
    EXPECT_EQ(lost.grid().count, nodes(1.0));
    EXPECT_EQ(rms(lost.correction()), 0.0);
}

TEST(MadeSketch, IsTheCoarsestThatIsNearEnough) {
    const gap::Record record = waves(81);
    const gap::Record thin = gap::thinned(record, 2);
    const gap::Course fine(record, 2);
    const Values wanted = gap::simulate(swinging(), fine);
    const auto off = [&](double per_interval) {
        Values by = gap::simulate(swinging(), gap::Course(thin, per_interval));
        for (std::size_t i = 0; i < by.size(); ++i) {
            by[i] = wanted[2 * i] - by[i];
        }
        return by;
    };
    for (const double per_interval : {0.25, 0.5, 1.0}) {
        const gap::Course near = gap::make_sketch(fine, thin, 2, swinging(), 1.0001 * rms(off(per_interval)));
        EXPECT_EQ(near.grid().count, thin.grid(per_interval).count);
        expect_near(near.correction(), off(per_interval), 0, 1e-15);
        EXPECT_EQ(gap::make_sketch(fine, thin, 2, swinging(), 0.9999 * rms(off(per_interval))).grid().count,
                  thin.grid(2.0 * per_interval).count);
    }
    // As many nodes to the record's interval as there are samples, at most; as the fine one has where those are off by
    // a twentieth of what is simulated.
    gap::Scenario slow = swinging();
    slow.model.denominator.front().coefficient *= 30.0;
    const auto nodes_of = [&](const gap::Scenario& scenario) {
        return gap::make_sketch(fine, thin, 2, scenario, 0.0).grid().count;
    };
    EXPECT_EQ(nodes_of(swinging()), thin.grid(4.0).count);
    EXPECT_EQ(nodes_of(slow), thin.grid(2.0).count);
    gap::Scenario away = swinging();
    away.model.gain = 1e13;
    EXPECT_EQ(rms(gap::make_sketch(fine, thin, 2, away, 0.1).correction()), 0.0);
}

// --- What was deployed.

TEST(DeployedReadings, AreThoseOfTheScheme) {
    const gap::Record record = waves(60);
    const gap::Course course(record, 1);
    const drive::Model model = swinging().model;
    // At a third of the log's interval each level lasts three steps.
    const auto ran = [&](double step_s, std::size_t each, std::optional<std::size_t> taps) {
        drive::Scheme scheme;
        scheme.step_s = step_s;
        if (taps) {
            scheme.taps = *taps;
        }
        Values input;
        for (const double u : record.input) {
            input.insert(input.end(), each, u);
        }
        const Values all = drive::simulate(model, scheme, input).output;
        Values at_stamps;
        for (std::size_t i = 0; i < record.size(); ++i) {
            at_stamps.push_back(all[each * i]);
        }
        return at_stamps;
    };
    expect_near(course.deployed(model, {h / 3.0, 0.0, ""}, 0), ran(h / 3.0, 3, {}), 0, 1e-9);
    expect_near(course.deployed(model, {h / 3.0, 0.0, ""}, 20), ran(h / 3.0, 3, 20), 0, 1e-9);
    // Of 0 the step is the model's own, or the log's.
    expect_near(course.deployed(model, {0.0, 0.0, ""}, 0), ran(h, 1, {}), 0, 1e-9);
    drive::Model stepped = model;
    stepped.sample_time_s = h / 2.0;
    expect_near(course.deployed(stepped, {0.0, 0.0, ""}, 0), ran(h / 2.0, 2, {}), 0, 1e-9);
    // A memory between whole numbers is a mixture of both; of less than two samples it is one of two.
    const auto shows = [&](double taps) {
        gap::Scenario scenario = swinging();
        scenario.deployed = gap::Deployed{h, taps, ""};
        return gap::simulate(scenario, course);
    };
    const Values shorter = ran(h, 1, 20);
    const Values longer = ran(h, 1, 21);
    Values mixed;
    for (std::size_t i = 0; i < shorter.size(); ++i) {
        mixed.push_back(0.75 * shorter[i] + 0.25 * longer[i]);
    }
    expect_near(shows(20.0), shorter, 0, 1e-9);
    expect_near(shows(20.25), mixed, 0, 1e-9);
    expect_near(shows(1.5), ran(h, 1, 2), 0, 1e-9);
    expect_near(shows(0.0), ran(h, 1, {}), 0, 1e-9);
    const Values whole = ran(h, 1, {});
    // A stamp that is late by a millionth of a step belongs to that step.
    const auto moved_by_a_late_stamp = [&](double by) {
        gap::Record off = record;
        off.time_s[30] += by * h;
        const Values found = gap::Course(off, 1).deployed(model, {h, 0.0, ""}, 0);
        double largest = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            largest = std::max(largest, std::fabs(found[i] - whole[i]));
        }
        return largest;
    };
    EXPECT_LT(moved_by_a_late_stamp(0.995e-6), 1e-5);
    EXPECT_GT(moved_by_a_late_stamp(1.005e-6), 1e-4);
}

// What differs in anything is another simulation, whatever was asked for before.
TEST(DeployedReadings, AreKeptByAllThatTheyDependOn) {
    const gap::Record record = waves(60);
    const gap::Course asked_before(record, 1);
    const drive::Model model = swinging().model;
    const gap::Deployed deployed{h, 0.0, "ring_horner_f32"};
    (void)asked_before.deployed(model, deployed, 30);
    const auto changed = [](auto of, const auto& change) {
        change(of);
        return of;
    };
    const std::vector<drive::Model> models{
        changed(model, [](auto& m) { m.gain = 1.25; }),
        changed(model, [](auto& m) { m.delay_s = 2.0 * h; }),
        changed(model,
                [](auto& m) {
                    m.numerator = {{0.5, 0.5}, {1.0, 0.0}};
                }),
        changed(model,
                [](auto& m) {
                    m.numerator = {{1.25, 0.0}};
                }),
        changed(model, [](auto& m) { m.denominator[1].coefficient = 0.7; }),
        changed(model, [](auto& m) { m.denominator[1].order = 0.8; }),
    };
    for (const drive::Model& other : models) {
        EXPECT_EQ(asked_before.deployed(other, deployed, 30), gap::Course(record, 1).deployed(other, deployed, 30));
        EXPECT_NE(asked_before.deployed(other, deployed, 30), asked_before.deployed(model, deployed, 30));
    }
    for (const gap::Deployed& other : {gap::Deployed{h / 2.0, 0.0, "ring_horner_f32"}, gap::Deployed{h, 0.0, ""},
                                       gap::Deployed{h, 0.0, "ring_horner_f32", true}}) {
        EXPECT_EQ(asked_before.deployed(model, other, 30), gap::Course(record, 1).deployed(model, other, 30));
        EXPECT_NE(asked_before.deployed(model, other, 30), asked_before.deployed(model, deployed, 30));
    }
    EXPECT_EQ(asked_before.deployed(model, deployed, 31), gap::Course(record, 1).deployed(model, deployed, 31));
    const gap::Deployed own{0.0, 0.0, ""};
    drive::Model stepped = model;
    (void)asked_before.deployed(stepped, own, 0);
    stepped.sample_time_s = h / 2.0;
    EXPECT_EQ(asked_before.deployed(stepped, own, 0), gap::Course(record, 1).deployed(stepped, own, 0));
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
// Sixty-four of them: with one more all are forgotten but that one, so that a fit of hours does not fill the memory.
TEST(DeployedReadings, AreSixtyFourAtMost) {
    const gap::Record record = waves(400);
    const gap::Course course(record, 1);
    const auto in_use = [&](std::size_t taps) {
        (void)course.deployed(swinging().model, {h, 0.0, ""}, taps);
        return mallinfo2().uordblks;
    };
    std::size_t before = in_use(100);
    for (std::size_t taps = 101; taps < 164; ++taps) {
        const std::size_t now = in_use(taps);
        EXPECT_GT(now, before) << taps - 99;
        before = now;
    }
    EXPECT_LT(in_use(164), before - 60 * 400 * sizeof(double));
}
#endif

}  // namespace
