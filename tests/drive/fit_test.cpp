// Identification: known models come back from their own exact responses, by the tangent, from a search, and through
// noise within what the fit says of itself.
#include "drive/fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "base/failure.hpp"
#include "drive/coverage.hpp"
#include "drive/response.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Acquisition;
using drive::Fit;
using drive::Form;
using drive::Kind;
using drive::Model;
using drive::Record;
using testing::Contains;
using testing::HasSubstr;

constexpr Acquisition clean = {
    .excitation = {.name = "step"}, .until_s = 6.0, .jitter_s = 0.001, .noise = 0.0, .quantum = 0.0};

Record record_of(const Model& model, const Acquisition& acquisition = clean, std::uint64_t seed = 1) {
    return drive::to_record(drive::take_log(model, acquisition, seed));
}

double value_of(const Fit& fit, const std::string& name) {
    for (const drive::Estimate& estimate : fit.parameters) {
        if (estimate.name == name) {
            return estimate.value;
        }
    }
    ADD_FAILURE() << "no parameter " << name;
    return 0.0;
}

TEST(Tangent, FindsTheModelsThatItIsMadeFor) {
    const Model first = drive::tangent_construction(Kind::fopdt, record_of(drive::make_fopdt(2.0, 0.4934, 1.2279)));
    EXPECT_NEAR(first.gain, 2.0, 0.01);
    EXPECT_NEAR(first.denominator[0].coefficient, 0.4934, 0.05);  // the steepest part is at the very start
    EXPECT_NEAR(first.delay_s, 1.2279, 0.02);
    const Model second = drive::tangent_construction(Kind::sopdt, record_of(plants::sopdt()));
    EXPECT_NEAR(second.gain, 1.0, 0.005);
    EXPECT_NEAR(second.denominator[1].coefficient / 2.0, 0.319, 0.005);
    EXPECT_NEAR(second.delay_s, 1.064, 0.005);
}

TEST(Tangent, RefusesWhatHasNotSettled) {
    Acquisition shorter = clean;
    shorter.until_s = 1.8;
    EXPECT_THROW((void)drive::tangent_construction(Kind::fopdt, record_of(plants::niopdt(), shorter)), glsum::Failure);
}

// A search looks on a grid of 60 time constants and 100 dead times: it ends beside the truth, wherever that lies.
TEST(SearchStart, EndsBesideTheTruth) {
    for (const double time_constant_s : {0.2, 0.4, 1.1}) {
        for (const double delay_s : {0.0, 0.33, 1.8}) {
            const Model first =
                drive::search_start(Kind::fopdt, {record_of(drive::make_fopdt(-3.0, time_constant_s, delay_s))});
            EXPECT_NEAR(first.gain, -3.0, 0.03);
            EXPECT_NEAR(first.denominator[0].coefficient / time_constant_s, 1.0, 0.15);
            EXPECT_NEAR(first.delay_s, delay_s, 0.065);
            const Model second =
                drive::search_start(Kind::sopdt, {record_of(drive::make_sopdt(2.0, time_constant_s, delay_s))});
            EXPECT_NEAR(second.gain, 2.0, 0.03);
            EXPECT_NEAR(std::sqrt(second.denominator[0].coefficient) / time_constant_s, 1.0, 0.12);
            EXPECT_NEAR(second.delay_s, delay_s, 0.065);
        }
    }
    // The lightest damping, and one in the middle, of a second order that swings.
    for (const double damping : {0.05, 0.5}) {
        Model swinging = drive::make_sopdt(1.0, 0.15, 0.5);
        swinging.kind = Kind::fotf;
        swinging.denominator[1].coefficient *= damping;
        const Model found = drive::search_start(Kind::niopdt, {record_of(swinging)});
        EXPECT_NEAR(std::sqrt(found.denominator[0].coefficient) / 0.15, 1.0, 0.06);
        EXPECT_NEAR(found.denominator[1].coefficient / swinging.denominator[1].coefficient, 1.0, 0.6);
        EXPECT_NEAR(found.delay_s, 0.5, 0.1);
    }
    // Two records at once, of other lengths and sizes.
    Acquisition shorter = clean;
    shorter.until_s = 3.0;
    shorter.excitation = {.name = "pulse", .amplitude = 0.25, .off_s = 1.5};
    const Model both = drive::search_start(Kind::fopdt, {record_of(drive::make_fopdt(2.0, 0.3, 0.4), shorter, 2),
                                                         record_of(drive::make_fopdt(2.0, 0.3, 0.4))});
    EXPECT_NEAR(both.gain, 2.0, 0.04);
    EXPECT_NEAR(both.denominator[0].coefficient, 0.3, 0.04);
    Record silent = record_of(plants::fopdt());
    std::fill(silent.output.begin(), silent.output.end(), 0.0);
    EXPECT_THROW((void)drive::search_start(Kind::fopdt, {silent}), glsum::Failure);
}

TEST(Fit, FindsEachFormFromNothing) {
    const Fit first = drive::fit_from_nothing(Kind::fopdt, {record_of(plants::fopdt())}, {});
    EXPECT_NEAR(value_of(first, "time_constant_s"), 0.4934, 1e-6);
    EXPECT_NEAR(value_of(first, "delay_s"), 1.2279, 1e-6);
    const Fit second = drive::fit_from_nothing(Kind::sopdt, {record_of(plants::sopdt())}, {});
    EXPECT_NEAR(value_of(second, "time_constant_s"), 0.319, 1e-6);
    EXPECT_NEAR(value_of(second, "gain"), 1.0, 1e-7);
    const Fit third = drive::fit_from_nothing(Kind::niopdt, {record_of(plants::niopdt())}, {});
    EXPECT_NEAR(value_of(third, "a2"), 0.18234, 1e-4);
    EXPECT_NEAR(value_of(third, "alpha2"), 1.9909, 1e-4);
    EXPECT_NEAR(value_of(third, "a1"), 0.65536, 1e-4);
    EXPECT_NEAR(value_of(third, "alpha1"), 0.98319, 1e-4);
    EXPECT_NEAR(value_of(third, "a0"), 0.9992, 1e-5);
    EXPECT_NEAR(value_of(third, "delay_s"), 1.0, 1e-4);
    EXPECT_LT(third.sum_of_squares, 1e-9);
}

TEST(Fit, FindsAFreeFormWithAZeroFromAnyStart) {
    Model truth;
    truth.numerator = {{0.4, 0.6}, {1.0, 0.0}};
    truth.denominator = {{0.5, 1.5}, {1.0, 0.0}};
    truth.delay_s = 0.2;
    Model start = truth;
    start.numerator[0] = {0.2, 0.5};
    start.denominator[0] = {0.8, 1.3};
    start.delay_s = 0.3;
    Form form(Kind::fotf, start);
    form.parameter("b0").fixed = true;  // it and a0 are the gain
    const Fit found = drive::fit(form, {record_of(truth)}, {});
    EXPECT_NEAR(value_of(found, "b1"), 0.4, 1e-4);
    EXPECT_NEAR(value_of(found, "beta1"), 0.6, 1e-4);
    EXPECT_NEAR(value_of(found, "alpha1"), 1.5, 1e-4);
    EXPECT_NEAR(value_of(found, "delay_s"), 0.2, 1e-4);
}

TEST(Fit, HoldsBoundsAndFixedParameters) {
    Form form(Kind::sopdt, drive::make_sopdt(1.0, 0.5, 1.0));
    form.parameter("delay_s").fixed = true;
    form.parameter("time_constant_s").upper = 0.55;
    form.parameter("time_constant_s").lower = 0.45;
    const Fit found = drive::fit(form, {record_of(plants::sopdt())}, {});
    EXPECT_EQ(value_of(found, "delay_s"), 1.0);
    EXPECT_NEAR(value_of(found, "time_constant_s"), 0.45, 1e-9);
    EXPECT_THAT(found.warnings, Contains(HasSubstr("time_constant_s: ends at its bound")));
    EXPECT_THROW((void)form.parameter("tau"), glsum::Failure);
    form.parameter("time_constant_s").value = 7.0;
    EXPECT_THROW((void)drive::fit(form, {record_of(plants::sopdt())}, {}), glsum::Failure);
}

TEST(Fit, StopsByBothRules) {
    const std::vector<Record> records{record_of(plants::sopdt())};
    const Form form(Kind::sopdt, drive::make_sopdt(1.2, 0.6, 0.7));
    const Fit all = drive::fit(form, records, {});
    const Fit accepted = drive::fit(form, records, {.accepted_error = 1e-3});
    EXPECT_THAT(accepted.stopped, HasSubstr("E_c"));
    EXPECT_LE(accepted.sum_of_squares, 1e-3);
    EXPECT_GT(accepted.sum_of_squares, all.sum_of_squares);
    const Fit once = drive::fit(form, records, {.iterations = 1});
    EXPECT_THAT(once.stopped, HasSubstr("number of iterations"));
    EXPECT_EQ(once.iterations, 1);
}

TEST(Fit, TakesSeveralRecordsAtOnce) {
    Acquisition staircase = clean;
    staircase.excitation = {.name = "staircase", .amplitude = 2.0, .stairs = 2};
    const Fit found = drive::fit_from_nothing(
        Kind::sopdt, {record_of(plants::sopdt()), record_of(plants::sopdt(), staircase, 2)}, {});
    EXPECT_NEAR(value_of(found, "time_constant_s"), 0.319, 1e-6);
    EXPECT_NEAR(value_of(found, "delay_s"), 1.064, 1e-6);
}

TEST(Fit, FreesAnOffset) {
    Record record = record_of(plants::sopdt());
    for (double& value : record.output) {
        value += 0.25;
    }
    Form form(Kind::sopdt, drive::make_sopdt(1.1, 0.4, 0.9));
    form.parameter("offset").fixed = false;
    const Fit found = drive::fit(form, {record}, {});
    EXPECT_NEAR(found.offset, 0.25, 1e-7);
    EXPECT_NEAR(drive::simulate_fit(found, record).front(), 0.25, 1e-7);
}

TEST(Fit, StartsInManyPlacesAndSaysHowManyAgree) {
    const Form form(Kind::fopdt, drive::make_fopdt(3.0, 3.0, 0.1));
    const Fit found = drive::fit(form, {record_of(plants::fopdt())}, {.starts = 6, .jobs = 2});
    EXPECT_NEAR(value_of(found, "time_constant_s"), 0.4934, 1e-5);
    EXPECT_EQ(found.starts, 6U);
    EXPECT_GE(found.starts_that_agree, 1U);
}

// A fractional plant that swings, and a record of it: another for each seed.
std::pair<Model, Record> swinging_plant(std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    Model truth = plants::niopdt();
    const double a2 = between(0.1, 0.4);
    const double alpha2 = between(1.85, 1.99);
    const double a1 = between(0.02, 0.12);
    truth.denominator = {{a2, alpha2}, {a1, between(0.7, 1.1)}, {1.0, 0.0}};
    truth.delay_s = between(0.1, 0.6);
    Acquisition noisy = clean;
    noisy.until_s = 8.0;
    noisy.interval_s = 0.04;
    noisy.noise = 0.004;
    return {truth, record_of(truth, noisy)};
}

// Such plants have many minima: a descent from two equal time constants ends in one that leaves waves.
TEST(Fit, BeginsAmongModelsThatSwingWhereThePlantDoes) {
    for (const unsigned seed : {1U, 4U, 10U, 16U, 28U}) {
        const auto [truth, record] = swinging_plant(seed);
        const Fit fit = drive::fit_from_nothing(Kind::niopdt, {record}, {});
        EXPECT_NEAR(fit.noise_deviation, 0.004, 0.15 * 0.004) << seed << ": " << drive::to_text(truth);
        EXPECT_GT(value_of(fit, "alpha2"), value_of(fit, "alpha1")) << seed;
    }
}

TEST(Fit, StartsAgainWhereItEndsPoorlyAndNamesTermsInTheirOrder) {
    const auto [truth, record] = swinging_plant(10);
    const Model damped = drive::fit(Form(Kind::sopdt, drive::search_start(Kind::sopdt, {record})), {record}, {}).model;
    const Fit fit = drive::fit(Form(Kind::niopdt, damped), {record}, {.starts_if_poor = 7, .jobs = 2});
    EXPECT_EQ(fit.starts, 8U);  // else nothing was tried
    EXPECT_GE(fit.starts_that_agree, 1U);
    EXPECT_NEAR(fit.noise_deviation, 0.004, 0.15 * 0.004) << drive::to_text(truth);
    EXPECT_GT(value_of(fit, "alpha2"), value_of(fit, "alpha1"));
}

// A third order without a dead time to spare bends as no order up to 2.5 does.
TEST(Fit, HoldsOrdersBelowTwoWhereTheyRunAwayAndSaysThatTheFormDoesNotDescribeTheRecord) {
    Model third = plants::niopdt();
    third.denominator = {{0.125, 3.0}, {0.2, 2.0}, {0.8, 1.0}, {1.0, 0.0}};
    third.delay_s = 0.0;
    const Record record = record_of(third);
    const auto says_so = Contains(
        testing::AllOf(HasSubstr("orders beyond 2"), HasSubstr("does not describe"), HasSubstr("glsum diagnose")));
    Form form(Kind::niopdt, drive::search_start(Kind::niopdt, {record}));
    const Fit found = drive::fit(form, {record}, {.jobs = 2});
    EXPECT_LE(value_of(found, "alpha2"), 2.0);
    EXPECT_THAT(found.warnings, says_so);
    form.parameter("alpha2").bounds_are_given = true;
    const Fit asked_for = drive::fit(form, {record}, {.jobs = 2});
    EXPECT_DOUBLE_EQ(value_of(asked_for, "alpha2"), 2.5);
    EXPECT_THAT(asked_for.warnings, testing::Not(says_so));
    EXPECT_LT(asked_for.sum_of_squares, found.sum_of_squares);
}

// What Ceres finds out about a start that no model can be made of goes to no terminal.
TEST(Fit, IsSilent) {
    Form form(Kind::sopdt, plants::sopdt());
    form.parameter("gain").value = 0.0;
    testing::internal::CaptureStderr();
    EXPECT_THROW((void)drive::fit(form, {record_of(plants::sopdt())}, {}), glsum::Failure);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Fit, BeginsOnceAndEndsByItsStepsUnlessToldOtherwise) {
    const drive::FitOptions usual;
    EXPECT_EQ(usual.accepted_error, 0.0);
    EXPECT_EQ(usual.iterations, 200);
    EXPECT_EQ(usual.starts, 1U);
    EXPECT_EQ(usual.starts_if_poor, 0U);
    EXPECT_EQ(usual.seed, 1U);
    EXPECT_FALSE(usual.prediction_error);
    EXPECT_FALSE(usual.profile);
    EXPECT_EQ(usual.jobs, 1U);
}

// Terms that came to stand the other way round are told in their order, with the deviations that are theirs.
TEST(Fit, DeviationsGoWithTheTermsThatAreGivenTheirOrder) {
    Acquisition noisy = clean;
    noisy.noise = 0.005;
    const Record record = record_of(plants::niopdt(), noisy, 5);
    Form straight(Kind::niopdt, plants::niopdt());
    Form other(Kind::niopdt, plants::niopdt());
    std::swap(other.parameter("a1").value, other.parameter("a2").value);
    std::swap(other.parameter("alpha1").value, other.parameter("alpha2").value);
    for (Form* form : {&straight, &other}) {
        for (const char* order : {"alpha1", "alpha2"}) {
            form->parameter(order).lower = 0.5;
            form->parameter(order).upper = 2.5;
        }
    }
    const Fit one = drive::fit(straight, {record}, {});
    const Fit same = drive::fit(other, {record}, {});
    ASSERT_EQ(one.parameters.size(), same.parameters.size());
    for (std::size_t p = 0; p < one.parameters.size(); ++p) {
        const drive::Estimate& a = one.parameters[p];
        const drive::Estimate& b = same.parameters[p];
        EXPECT_EQ(a.name, b.name);
        EXPECT_NEAR(b.value, a.value, 0.05 * a.deviation) << a.name;
        EXPECT_NEAR(b.deviation, a.deviation, 0.05 * a.deviation) << a.name;
    }
    EXPECT_GT(value_of(same, "alpha2"), value_of(same, "alpha1"));
}

// Of 40 logs, as many intervals hold the truth as 95 % of them: 33 to 40 with probability 0.998 for one parameter.
TEST(Fit, IntervalsHoldTheTruth) {
    const auto found = drive::measure_coverage(plants::sopdt(), Kind::sopdt, {}, 40, 1, 1);
    EXPECT_EQ(found.failed, 0U);
    ASSERT_EQ(found.names.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GE(found.inside[i], 33U) << found.names[i];
        EXPECT_NEAR(found.claimed[i] / found.spread[i], 1.0, 0.35) << found.names[i];
    }
    EXPECT_GE(found.jointly_inside, 33U);
    EXPECT_LE(found.jointly_inside, 40U);
    EXPECT_EQ(found.runs, 40U);
    EXPECT_EQ(found.names, (std::vector<std::string>{"gain", "time_constant_s", "delay_s"}));
    EXPECT_EQ(found.truth, (std::vector<double>{1.0, 0.319, 1.064}));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(found.mean[i], found.truth[i], 4.0 * found.spread[i] / std::sqrt(40.0)) << found.names[i];
        EXPECT_LT(found.spread[i], 0.01) << found.names[i];
    }
}

// A curved parameter: the ends of a profile are where the least sum of squares over the others has grown by t^2
// variances, and not those of a straight interval.
TEST(Fit, ProfileIntervalsEndWhereTheSumOfSquaresHasGrown) {
    const Record record = record_of(plants::sopdt(), {.until_s = 3.0, .noise = 0.1, .quantum = 0.0});
    const Form form(Kind::sopdt, plants::sopdt());
    const Fit straight = drive::fit(form, {record}, {});
    const Fit found = drive::fit(form, {record}, {.profile = true});
    const double variance = found.noise_deviation * found.noise_deviation;
    constexpr double t = 1.968;  // Student's, 97.5 %, 298 degrees of freedom
    for (std::size_t i = 0; i < 3; ++i) {
        for (const double end : {found.parameters[i].low, found.parameters[i].high}) {
            Form there = form;
            there.parameters()[i].value = end;
            there.parameters()[i].fixed = true;
            const double grown = drive::fit(there, {record}, {}).sum_of_squares - found.sum_of_squares;
            EXPECT_NEAR(std::sqrt(grown / variance) / t, 1.0, 0.01) << found.parameters[i].name << ' ' << end;
        }
        EXPECT_NEAR(found.parameters[i].high - found.parameters[i].low,
                    straight.parameters[i].high - straight.parameters[i].low, found.parameters[i].deviation);
    }
    EXPECT_NE(found.parameters[1].low, straight.parameters[1].low);
    Form bounded = form;
    bounded.parameter("time_constant_s").value = found.parameters[1].value;
    bounded.parameter("time_constant_s").upper = found.parameters[1].value + 0.1 * found.parameters[1].deviation;
    EXPECT_DOUBLE_EQ(drive::fit(bounded, {record}, {.profile = true}).parameters[1].high,
                     bounded.parameter("time_constant_s").upper);
}

TEST(Fit, WarnsWhereTheRecordDoesNotTell) {
    // A record that ends in the dead time of a second order: gain and time constant only as a ratio.
    Acquisition brief = clean;
    brief.until_s = 1.3;
    brief.noise = 1e-3;
    const Fit found = drive::fit(Form(Kind::sopdt, plants::sopdt()), {record_of(plants::sopdt(), brief)}, {});
    EXPECT_FALSE(found.warnings.empty());
    Record flat = record_of(plants::sopdt());
    Form late(Kind::sopdt, drive::make_sopdt(1.0, 0.3, 50.0));
    late.parameter("delay_s").lower = 40.0;
    EXPECT_THAT(drive::fit(late, {flat}, {}).warnings, Contains(HasSubstr("nothing in the record depends on it")));
}

// Noise that remembers: white intervals are too narrow, and the fit says so; whitened ones are not.
TEST(Fit, ThePredictionErrorMethodWhitensColouredNoise) {
    Record record = record_of(plants::sopdt(), {.excitation = {.name = "step"}, .noise = 0.01, .quantum = 0.0});
    const std::vector<double> exact = drive::respond(plants::sopdt(), record.changes, record.time_s);
    double coloured = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        coloured = 0.9 * coloured + (record.output[i] - exact[i]);
        record.output[i] = exact[i] + coloured;
    }
    const Form form(Kind::sopdt, plants::sopdt());
    const Fit white = drive::fit(form, {record}, {});
    EXPECT_THAT(white.warnings, Contains(HasSubstr("not white")));
    const Fit whitened = drive::fit(form, {record}, {.prediction_error = true});
    ASSERT_FALSE(whitened.noise_model.empty());
    EXPECT_NEAR(whitened.noise_model[0], -0.9, 0.08);
    EXPECT_NEAR(whitened.noise_deviation, 0.01, 0.001);
    EXPECT_LT(std::fabs(whitened.lag_one), 0.1);
    EXPECT_GT(whitened.parameters[0].deviation, 2.0 * white.parameters[0].deviation);
}

// The noise model solves Yule's and Walker's equations of the residuals that it was made of.
TEST(Fit, TheNoiseModelSolvesYuleAndWalkersEquations) {
    Record record = record_of(plants::sopdt(), {.excitation = {.name = "step"}, .noise = 0.01, .quantum = 0.0});
    const std::vector<double> exact = drive::respond(plants::sopdt(), record.changes, record.time_s);
    double before = 0.0;
    double earlier = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const double noise = 1.1 * before - 0.5 * earlier + (record.output[i] - exact[i]);
        earlier = std::exchange(before, noise);
        record.output[i] = exact[i] + noise;
    }
    const Fit found = drive::fit(Form(Kind::sopdt, plants::sopdt()), {record}, {.prediction_error = true});
    ASSERT_EQ(found.noise_model.size(), 2U);
    const std::vector<double> fitted = drive::simulate_fit(found, record);
    const auto covariance = [&](std::size_t lag) {
        double sum = 0.0;
        for (std::size_t i = lag; i < fitted.size(); ++i) {
            sum += (record.output[i] - fitted[i]) * (record.output[i - lag] - fitted[i - lag]);
        }
        return sum;
    };
    const double c0 = covariance(0);
    const double c1 = covariance(1);
    const double c2 = covariance(2);
    const double determinant = c0 * c0 - c1 * c1;
    EXPECT_NEAR(found.noise_model[0], -(c1 * c0 - c1 * c2) / determinant, 1e-3);
    EXPECT_NEAR(found.noise_model[1], -(c2 * c0 - c1 * c1) / determinant, 1e-3);
}

TEST(Record, BeginsAtItsFirstStamp) {
    drive::Log log;
    for (int k = 0; k < 8; ++k) {
        log.time_s.push_back(5.0 + 0.25 * k);
        log.input.push_back(k < 3 ? 0.0 : 2.0);
        log.output.push_back(k);
    }
    const Record record = drive::to_record(log);
    EXPECT_EQ(record.time_s, (std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75}));
    ASSERT_EQ(record.changes.size(), 1U);
    EXPECT_EQ(record.changes[0].time_s, 0.75);
    EXPECT_EQ(record.changes[0].size, 2.0);
}

TEST(Record, RefusesWhatCannotBeIdentifiedFrom) {
    drive::Log log = drive::take_log(plants::sopdt(), clean, 1);
    drive::Log still = log;
    still.output.assign(log.output.size(), 3.0);
    EXPECT_THROW((void)drive::to_record(still), glsum::Failure);
    drive::Log off = log;
    off.input.assign(log.input.size(), 0.0);
    EXPECT_THROW((void)drive::to_record(off), glsum::Failure);
    log.time_s.resize(5);
    log.output.resize(5);
    log.input.resize(5);
    EXPECT_THROW((void)drive::to_record(log), glsum::Failure);
}

}  // namespace
