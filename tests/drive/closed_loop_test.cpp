// Closed loops: against a loop stepped by hand, and identified without the bias that the input's own noise brings.
#include "drive/closed_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <span>

#include "base/failure.hpp"
#include "drive/coverage.hpp"
#include "drive/fit.hpp"
#include "drive/inverse_laplace.hpp"
#include "drive/log.hpp"
#include "drive/model_file.hpp"

namespace {

using drive::Gains;
using drive::Kind;
using drive::Model;

constexpr double step_s = 0.02;
constexpr double gain = 2.0;
constexpr double time_constant_s = 0.5;
constexpr std::size_t delay_steps = 5;
const Gains pi{.kp = 0.6, .ki = 0.8};

Model plant() { return drive::make_fopdt(gain, time_constant_s, step_s * delay_steps); }

// A first order behind a dead time, held inputs, by its own recursion, and a PI controller by its: none of the library.
drive::Log step_by_hand(std::size_t count, double noise, double memory, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    drive::Log log;
    log.name = "by hand";
    const double left = std::exp(-step_s / time_constant_s);
    double y = 0.0;
    double integral = 0.0;
    double error = 0.0;
    double disturbance = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        if (k > 0) {
            const double u = k > delay_steps ? log.input[k - 1 - delay_steps] : 0.0;
            y = left * y + (1.0 - left) * gain * u;
            integral += pi.ki * step_s * error;
        }
        disturbance = memory * disturbance + noise * std::sqrt(1.0 - memory * memory) * normal(random);
        log.time_s.push_back(static_cast<double>(k) * step_s);
        log.reference.push_back((k / 100) % 2 == 0 ? 1.0 : 0.4);
        log.output.push_back(y + disturbance);
        error = log.reference.back() - log.output.back();
        log.input.push_back(pi.kp * error + integral);
        log.line.push_back(k + 2);
    }
    return log;
}

double value_of(const drive::Fit& fit, const std::string& name) {
    for (const drive::Estimate& estimate : fit.parameters) {
        if (estimate.name == name) {
            return estimate.value;
        }
    }
    ADD_FAILURE() << "no parameter " << name;
    return 0.0;
}

TEST(ClosedLoop, IsTheOneSteppedByHand) {
    const drive::Log log = step_by_hand(400, 0.0, 0.0, 1);
    const auto run = drive::run_loop(plant(), drive::to_model(pi, "pi"), log.time_s, log.reference);
    for (std::size_t k = 0; k < log.output.size(); ++k) {
        ASSERT_NEAR(run.output[k], log.output[k], 1e-7) << k;
        ASSERT_NEAR(run.input[k], log.input[k], 1e-7) << k;
    }
    // Uneven stamps take another way: one of them moved a little is nearly the same loop.
    std::vector<double> moved = log.time_s;
    moved[300] += 1e-6;
    const auto uneven = drive::run_loop(plant(), drive::to_model(pi, "pi"), moved, log.reference);
    EXPECT_NEAR(uneven.output[399], log.output[399], 1e-5);
    EXPECT_NE(uneven.output[399], run.output[399]);
}

// How the output moves with the reading's offset and with the plant's gain, whatever their order: by differences.
TEST(ClosedLoop, KnowsHowItMovesWithOffsetAndGain) {
    const drive::Log log = step_by_hand(200, 0.0, 0.0, 3);
    const Model controller = drive::to_model(pi, "pi");
    const auto output_at = [&](double plant_gain, double offset) {
        return drive::run_loop(drive::make_fopdt(plant_gain, time_constant_s, step_s * delay_steps), controller,
                               log.time_s, log.reference, offset)
            .output;
    };
    constexpr double by = 1e-4;
    const auto more = output_at(gain, by);
    const auto less = output_at(gain, -by);
    const auto stronger = output_at(gain + by, 0.0);
    const auto weaker = output_at(gain - by, 0.0);
    for (const std::ptrdiff_t offset_column : {0, 1}) {
        drive::InverseLaplace of_gain(2,
                                      [](std::complex<double> s, std::span<std::complex<double>> out) {
                                          out[1] = 1.0 / (s * (1.0 + time_constant_s * s));
                                          out[0] = gain * out[1];
                                      },
                                      {});
        Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(1, 2);
        chain(0, 1 - offset_column) = 1.0;
        const drive::LoopRun run = drive::run_loop(of_gain, 2, step_s * delay_steps, controller, log.time_s,
                                                   log.reference, 0.0, {}, drive::Sensitivity{&chain, offset_column});
        for (std::size_t k = 0; k < log.time_s.size(); ++k) {
            const auto row = static_cast<Eigen::Index>(k);
            ASSERT_NEAR(run.sensitivities(row, offset_column), (more[k] - less[k]) / (2.0 * by), 1e-5) << k;
            ASSERT_NEAR(run.sensitivities(row, 1 - offset_column), (stronger[k] - weaker[k]) / (2.0 * by), 1e-5) << k;
        }
    }
}

TEST(ClosedLoop, SeesItsDisturbance) {
    const drive::Log log = step_by_hand(200, 0.1, 0.5, 2);
    const auto quiet = drive::run_loop(plant(), drive::to_model(pi, "pi"), log.time_s, log.reference);
    std::vector<double> disturbance;
    std::vector<double> output = quiet.output;
    // What disturbs is the reading less the plant's output, and that follows from the input.
    const auto changes = drive::changes_of(log.time_s, log.input);
    const auto driven = drive::respond(plant(), changes, log.time_s);
    for (std::size_t k = 0; k < log.output.size(); ++k) {
        disturbance.push_back(log.output[k] - driven[k]);
    }
    const auto run = drive::run_loop(plant(), drive::to_model(pi, "pi"), log.time_s, log.reference, 0.0, disturbance);
    for (std::size_t k = 0; k < log.output.size(); ++k) {
        ASSERT_NEAR(run.input[k], log.input[k], 1e-6) << k;
    }
}

TEST(ClosedLoop, RecoversTheReference) {
    const drive::Log log = step_by_hand(300, 0.2, 0.9, 3);
    const auto reference = drive::recover_reference(drive::to_model(pi, "pi"), log.time_s, log.input, log.output);
    for (std::size_t k = 0; k < log.output.size(); ++k) {
        ASSERT_NEAR(reference[k], log.reference[k], 1e-8) << k;
    }
    const Model slow = drive::make_fopdt(1.0, 0.1, 0.0);  // answers later
    EXPECT_THROW((void)drive::recover_reference(slow, log.time_s, log.input, log.output), glsum::Failure);
}

TEST(ClosedLoop, ItsPlantComesBackFromNothing) {
    drive::Log log = step_by_hand(500, 0.0, 0.0, 4);
    const Model controller = drive::to_model(pi, "pi");
    const auto found = drive::fit_from_nothing(Kind::fopdt, {drive::to_record(log, controller)}, {});
    EXPECT_NEAR(value_of(found, "gain"), gain, 1e-5);
    EXPECT_NEAR(value_of(found, "time_constant_s"), time_constant_s, 1e-5);
    EXPECT_NEAR(value_of(found, "delay_s"), step_s * delay_steps, 1e-5);
    log.reference.clear();  // what input and output leave no choice about
    drive::Form form(Kind::fopdt, drive::make_fopdt(1.5, 0.7, 0.05));
    form.parameter("offset").fixed = false;
    const auto recovered = drive::fit(form, {drive::to_record(log, controller)}, {});
    EXPECT_NEAR(value_of(recovered, "gain"), gain, 1e-5);
    EXPECT_NEAR(value_of(recovered, "offset"), 0.0, 1e-5);
}

// The sensitivities of a loop are what differences of it say, the offset's included.
TEST(ClosedLoop, FindsAnOffsetThatTheControllerSees) {
    drive::Log log = step_by_hand(300, 0.0, 0.0, 5);
    const Model controller = drive::to_model(pi, "pi");
    const auto shifted = drive::run_loop(plant(), controller, log.time_s, log.reference, 0.15);
    for (std::size_t k = 0; k < log.output.size(); ++k) {
        log.output[k] = shifted.output[k] + 0.15;
    }
    drive::Form form(Kind::fopdt, drive::make_fopdt(1.8, 0.6, 0.08));
    form.parameter("offset").fixed = false;
    const auto found = drive::fit(form, {drive::to_record(log, controller)}, {});
    EXPECT_NEAR(value_of(found, "offset"), 0.15, 1e-5);
    EXPECT_NEAR(value_of(found, "gain"), gain, 1e-4);
    EXPECT_LT(found.iterations, 30);
}

// The input answers the noise. A direct fit takes part of that answer for the plant, here for a longer dead time; the
// loop's fit does not.
TEST(ClosedLoop, DirectFitsAreBiasedAndIndirectOnesAreNot) {
    const Model controller = drive::to_model(pi, "pi");
    constexpr int runs = 12;
    std::vector<double> direct;
    std::vector<double> indirect;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        const drive::Log log = step_by_hand(200, 0.4, 0.8, seed);
        const drive::Form form(Kind::fopdt, plant());
        direct.push_back(value_of(drive::fit(form, {drive::to_record(log)}, {}), "delay_s"));
        indirect.push_back(value_of(drive::fit(form, {drive::to_record(log, controller)}, {}), "delay_s"));
    }
    const auto bias_in_errors = [](const std::vector<double>& values) {
        double mean = 0.0;
        for (const double value : values) {
            mean += value / runs;
        }
        double square = 0.0;
        for (const double value : values) {
            square += (value - mean) * (value - mean);
        }
        return (mean - step_s * delay_steps) / std::sqrt(square / (runs - 1) / runs);
    };
    EXPECT_GT(bias_in_errors(direct), 3.0);
    EXPECT_LT(std::fabs(bias_in_errors(indirect)), 2.5);
}

TEST(Controller, IsWhatItsGainsSay) {
    const Model pid =
        drive::parse_controller(R"({"kind": "pid", "kp": 2, "ki": 1.5, "kd": 0.1, "filter_s": 0.02})", "pid.json");
    for (const std::complex<double> s : {std::complex<double>(0.3, 1.0), std::complex<double>(0.0, 40.0)}) {
        const auto expected = 2.0 + 1.5 / s + 0.1 * s / (0.02 * s + 1.0);
        EXPECT_LT(std::abs(drive::evaluate_without_delay(pid, s) - expected), 1e-12 * std::abs(expected));
    }
    EXPECT_DOUBLE_EQ(drive::direct_gain(pid), 2.0 + 0.1 / 0.02);
    const Model fractional =
        drive::parse_controller(R"({"kind": "pid", "kp": 2, "ki": 1.5, "integral_order": 0.7})", "pid.json");
    const std::complex<double> s(0.2, 3.0);
    EXPECT_LT(std::abs(drive::evaluate_without_delay(fractional, s) - (2.0 + 1.5 / std::pow(s, 0.7))), 1e-12);
    EXPECT_DOUBLE_EQ(drive::direct_gain(drive::to_model({.kp = 3.0}, "p")), 3.0);
    EXPECT_DOUBLE_EQ(drive::direct_gain(drive::make_fopdt(1.0, 1.0, 0.0)), 0.0);
}

std::string refusal(const std::string& text) {
    try {
        (void)drive::parse_controller(text, "c.json");
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "accepted";
}

TEST(Controller, RefusesWhatIsNone) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal(R"({"kind": "pid"})"), HasSubstr("c.json: expected kp, ki or kd other than 0"));
    EXPECT_THAT(refusal(R"({"kind": "pid", "kp": 1, "kd": 1})"), HasSubstr("filter_s: expected a time above 0"));
    EXPECT_THAT(refusal(R"({"kind": "pid", "kp": 1, "integral_order": -1})"), HasSubstr("integral_order above 0"));
    EXPECT_THAT(refusal(R"({"kind": "pid", "kp": 1, "gain": 2})"), HasSubstr(R"(found {"gain":2})"));
    EXPECT_THAT(refusal(R"({"kind": "pid", "kp": "much"})"), HasSubstr("kp: expected a number"));
    EXPECT_THAT(refusal("{\"kind\": \"pid\","), HasSubstr("ends in the middle"));
}

TEST(ClosedLoop, RefusesUnstableAndTooLongOnes) {
    const drive::Log log = step_by_hand(400, 0.0, 0.0, 1);
    EXPECT_THROW((void)drive::run_loop(plant(), drive::to_model({.kp = 50.0}, "p"), log.time_s, log.reference),
                 glsum::Failure);
    const std::vector<double> time_s(drive::most_loop_samples + 1, 0.0);
    EXPECT_THROW((void)drive::run_loop(plant(), drive::to_model(pi, "pi"), time_s, time_s), glsum::Failure);
    EXPECT_THROW((void)drive::tangent_construction(Kind::fopdt, drive::to_record(log, drive::to_model(pi, "pi"))),
                 glsum::Failure);
    drive::Log still = log;
    still.reference.assign(still.reference.size(), 0.0);
    EXPECT_THROW((void)drive::to_record(still, drive::to_model(pi, "pi")), glsum::Failure);
}

}  // namespace
