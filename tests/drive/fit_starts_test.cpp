// Where a fit begins again: within what its page says of each parameter. Every descent ends where it begins here, since
// any error is accepted, and the best of the beginnings is what is told; and when it begins again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drive/coverage.hpp"
#include "drive/fit.hpp"
#include "drive/response.hpp"
#include "tests/drive/plants.hpp"
#include "tests/drive/seen.hpp"

namespace {

using drive::Form;
using drive::Kind;
using drive::Model;
using drive::Record;
using test::Seen;

constexpr double length_s = 6.0;

Record stepped(const Model& model) {
    Record record;
    record.name = "step";
    record.changes = {{0.0, 1.0}};
    for (int k = 0; k <= 12; ++k) {
        record.time_s.push_back(0.5 * k);
    }
    record.output = drive::respond(model, record.changes, record.time_s);
    return record;
}

// The values of one free parameter at which a fit of two starts begins, over many seeds; of the given start and another
// that which is nearer to the truth.
Seen starts_of(const char* name, const Model& given, const Model& truth) {
    Form form(given.kind == Kind::fotf ? Kind::niopdt : given.kind, given);
    for (drive::Parameter& parameter : form.parameters()) {
        parameter.fixed = parameter.name != name;
    }
    Seen seen;
    const Record record = stepped(truth);
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const drive::Fit fit = drive::fit(form, {record}, {.accepted_error = 1e300, .starts = 2, .seed = seed});
        EXPECT_EQ(fit.starts, 2U);
        for (const drive::Estimate& estimate : fit.parameters) {
            if (estimate.name == name) {
                seen(estimate.value);
            }
        }
    }
    return seen;
}

// Any up to half of the longest record.
TEST(FitStarts, DeadTimesAreOfHalfTheRecord) {
    const Model late = drive::make_fopdt(1.0, 0.5, 0.9 * length_s);
    const Seen near = starts_of("delay_s", late, drive::make_fopdt(1.0, 0.5, 0.0));
    EXPECT_GE(near.least, 0.0);
    EXPECT_LT(near.least, 0.005 * length_s);
    EXPECT_LE(near.most, 0.5 * length_s);
    EXPECT_GT(near.most, 0.495 * length_s);
}

// A factor of e^-1.2 to e^1.2 of the value that was given.
TEST(FitStarts, GainsAndTimesAreWithinAFactorOfTheGiven) {
    const double factor = std::exp(1.2);
    const Model given = drive::make_fopdt(1.0, 0.5, 0.2);
    const Seen up = starts_of("gain", given, drive::make_fopdt(4.0, 0.5, 0.2));
    EXPECT_GE(up.least, 1.0);
    EXPECT_LE(up.most, factor);
    EXPECT_GT(up.most, 0.99 * factor);
    const Seen down = starts_of("time_constant_s", given, drive::make_fopdt(1.0, 0.05, 0.2));
    EXPECT_GE(down.least, 0.5 / factor);
    EXPECT_LT(down.least, 1.01 * 0.5 / factor);
}

// Orders move by up to 0.3 to either side.
TEST(FitStarts, OrdersAreWithinThreeTenthsOfTheGiven) {
    Model given;
    given.denominator = {{0.3, 1.8}, {0.8, 0.9}, {1.0, 0.0}};
    Model low = given;
    low.denominator[1].order = 0.5;
    Model high = given;
    high.denominator[1].order = 1.3;
    const Seen down = starts_of("alpha1", given, low);
    EXPECT_GE(down.least, 0.6);
    EXPECT_LT(down.least, 0.604);
    const Seen up = starts_of("alpha1", given, high);
    EXPECT_LE(up.most, 1.2);
    EXPECT_GT(up.most, 1.196);
}

// Starts agree whose sums of squares are within a thousandth of the least; one that stands alone is warned of.
TEST(FitStarts, AgreeWhoseErrorsAreAlike) {
    Form form(Kind::fopdt, drive::make_fopdt(1.0, 0.5, 0.2));
    for (drive::Parameter& parameter : form.parameters()) {
        parameter.fixed = parameter.name != "gain";
    }
    const Record record = stepped(drive::make_fopdt(2.0, 0.5, 0.2));
    const drive::Fit alone = drive::fit(form, {record}, {.accepted_error = 1e300, .starts = 4});
    EXPECT_EQ(alone.starts_that_agree, 1U);
    const auto says_so = [](const drive::Fit& fit) {
        return std::any_of(fit.warnings.begin(), fit.warnings.end(), [](const std::string& warning) {
            return warning.find("only one of 4 starts ends here") != std::string::npos;
        });
    };
    EXPECT_TRUE(says_so(alone));
    Record noisy = record;  // so that there is a least
    for (std::size_t k = 0; k < noisy.output.size(); ++k) {
        noisy.output[k] += k % 2 == 0 ? 0.01 : -0.01;
    }
    const drive::Fit together = drive::fit(form, {noisy}, {.starts = 4});
    EXPECT_EQ(together.starts_that_agree, 4U);
    EXPECT_FALSE(says_so(together));
}

// Of a record that a first order made, two fractional ones are hardly known, and their descent creeps. What it has come
// to after 50 iterations is asked for as the error to accept: it has ended then. After 51 it has not.
TEST(FitStarts, AreMoreWhereTheFirstHasNotEndedAfterFiftyIterations) {
    drive::Acquisition noisy{
        .excitation = {.name = "step"}, .until_s = 8.0, .jitter_s = 0.0, .noise = 0.02, .quantum = 0.0};
    noisy.interval_s = 0.16;
    const Record record = drive::to_record(drive::take_log(plants::fopdt(), noisy, 11));
    Model given = plants::niopdt();
    given.denominator = {{0.3, 1.5}, {0.5, 0.8}, {1.0, 0.0}};
    const Form form(Kind::niopdt, given);
    const auto starts_to_reach = [&](int iterations) {
        const drive::Fit cut = drive::fit(form, {record}, {.iterations = iterations});
        EXPECT_EQ(cut.iterations, iterations);
        EXPECT_EQ(cut.stopped, "the number of iterations was reached");
        // Above what was reached by rounding; each iteration lowers it by some millionths.
        const double accepted = cut.sum_of_squares * (1.0 + 1e-9);
        return drive::fit(form, {record}, {.accepted_error = accepted, .starts_if_poor = 1}).starts;
    };
    EXPECT_EQ(starts_to_reach(50), 1U);
    EXPECT_EQ(starts_to_reach(51), 2U);
}

// Ten seconds of a swing that has decayed after two: what the response owes to each parameter is small by then, and
// no less known.
TEST(FitStarts, ASwingThatHasDecayedCanBeBegunAt) {
    Model truth;
    truth.denominator = {{0.0354235, 1.84434}, {0.0138941, 0.933182}, {1.0, 0.0}};
    truth.delay_s = 0.214017;
    Record record;
    record.name = "pulse";
    record.changes = {{0.0, 1.0}, {5.0, -1.0}};
    for (int k = 0; k < 1000; ++k) {
        record.time_s.push_back(0.01 * k);
    }
    record.output = drive::respond(truth, record.changes, record.time_s);
    Model near = truth;
    near.denominator[0].coefficient *= 1.01;
    const drive::Fit fit = drive::fit(Form(Kind::niopdt, near), {record}, {});
    EXPECT_LT(fit.sum_of_squares, 1e-10);
    EXPECT_NEAR(fit.model.denominator[1].order, truth.denominator[1].order, 1e-6);
}

}  // namespace
