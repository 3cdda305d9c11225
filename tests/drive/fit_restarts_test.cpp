// When a fit that ended begins again, and where it begins: on either side of each limit.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "drive/fit.hpp"
#include "drive/response.hpp"

namespace {

using drive::Fit;
using drive::Form;
using drive::Kind;
using drive::Model;
using drive::Record;

const Model plant = drive::make_fopdt(2.0, 0.5, 0.0);

Record stepped(const Model& model, int samples) {
    Record record;
    record.name = "step";
    record.changes = {{0.0, 1.0}};
    for (int k = 0; k < samples; ++k) {
        record.time_s.push_back(0.1 * k);
    }
    record.output = drive::respond(model, record.changes, record.time_s);
    return record;
}

Form with_free(const Model& model, const char* name) {
    Form form(Kind::fopdt, model);
    for (drive::Parameter& parameter : form.parameters()) {
        parameter.fixed = parameter.name != name;
    }
    return form;
}

// With more starts where the first ends poorly there are two, else one.
bool begins_again(const Form& form, const Record& record) {
    return drive::fit(form, {record}, {.starts_if_poor = 1}).starts == 2;
}

// Neighbours that are alike: of period 4 they neither agree nor disagree, of 32 they agree, but for two pairs in each.
Record coloured(const Record& record, double share, bool alike) {
    Record noisy = record;
    for (std::size_t k = 0; k < noisy.output.size(); ++k) {
        const double white = k % 4 < 2 ? 0.01 : -0.01;
        const double slow = (k % 32 < 16 ? 0.01 : -0.01) * (alike || k % 2 == 0 ? 1.0 : -1.0);
        noisy.output[k] += (1.0 - share) * white + share * slow;
    }
    return noisy;
}

// Four deviations of white noise's, of 64 samples a half; of 512 they are less, but a fifth is no reason yet.
TEST(FitRestarts, NeighboursThatAreAlikeAreAReason) {
    const Form form = with_free(plant, "gain");
    for (const auto& [samples, limit] : {std::pair(64, 0.5), std::pair(512, 0.2)}) {
        const Record record = stepped(plant, samples);
        double low = limit - 0.1;
        double high = limit + 0.2;
        double below = 0.0;
        double above = 1.0;
        for (int turn = 0; turn < 10; ++turn) {
            const double share = 0.5 * (low + high);
            const Record noisy = coloured(record, share, true);
            const double alike = drive::fit(form, {noisy}, {}).lag_one;
            EXPECT_EQ(begins_again(form, noisy), alike > limit) << alike;
            (alike > limit ? high : low) = share;
            (alike > limit ? above : below) = alike;
        }
        EXPECT_LT(above, 1.005 * limit);
        EXPECT_GT(below, 0.995 * limit);
        // Neighbours that are each other's opposites are none.
        const Record opposite = coloured(record, 0.9, false);
        EXPECT_LT(drive::fit(form, {opposite}, {}).lag_one, -limit);
        EXPECT_FALSE(begins_again(form, opposite));
    }
}

// A number that ends at its bound is a reason, but for a dead time, of which 0 is one like another.
TEST(FitRestarts, ABoundIsAReason) {
    const Record record = coloured(stepped(plant, 64), 0.0, true);
    EXPECT_FALSE(begins_again(with_free(plant, "gain"), record));
    Form bounded = with_free(plant, "gain");
    bounded.parameter("gain").upper = 1.999;
    bounded.parameter("gain").value = 1.9;
    EXPECT_TRUE(begins_again(bounded, record));
    bounded = with_free(plant, "gain");
    bounded.parameter("gain").lower = 2.001;
    bounded.parameter("gain").value = 2.1;
    EXPECT_TRUE(begins_again(bounded, record));
    // Two milliseconds early, which no dead time can be.
    Record early = record;
    for (double& time_s : early.time_s) {
        time_s += 0.002;
    }
    early.output = drive::respond(plant, early.changes, early.time_s);
    early.time_s = record.time_s;
    Form late = with_free(plant, "delay_s");
    late.parameter("delay_s").value = 0.05;
    const Fit fit = drive::fit(late, {coloured(early, 0.0, true)}, {.starts_if_poor = 1});
    ASSERT_LE(fit.model.delay_s, 1e-8);
    EXPECT_EQ(fit.starts, 1U);
}

TEST(FitRestarts, OfNoStartsThereIsOne) {
    const Form form = with_free(plant, "gain");
    EXPECT_EQ(drive::fit(form, {stepped(plant, 16)}, {.starts = 0}).starts, 1U);
}

// Where any error is accepted a fit ends where it begins: orders at their bounds a hundredth inside, all else as given.
TEST(FitRestarts, OrdersBeginAHundredthInsideTheirBounds) {
    Model given;
    given.denominator = {{0.3, 1.8}, {0.8, 0.9}, {1.0, 0.0}};
    const Record record = stepped(given, 16);
    const auto begun = [&](double order) {
        Form form(Kind::niopdt, given);
        for (drive::Parameter& parameter : form.parameters()) {
            parameter.fixed = parameter.name != "alpha1" && parameter.name != "a1";
        }
        form.parameter("alpha1").lower = 0.5;
        form.parameter("alpha1").upper = 1.5;
        form.parameter("alpha1").value = order;
        form.parameter("a1").lower = form.parameter("a1").value;
        const Fit fit = drive::fit(form, {record}, {.accepted_error = 1e300});
        double found = 0.0;
        for (const drive::Estimate& estimate : fit.parameters) {
            if (estimate.name == "alpha1") {
                found = estimate.value;
            } else if (estimate.name == "a1") {
                EXPECT_EQ(estimate.value, 0.8);
            }
        }
        return found;
    };
    EXPECT_NEAR(begun(0.5), 0.51, 1e-12);
    EXPECT_NEAR(begun(1.5), 1.49, 1e-12);
    EXPECT_NEAR(begun(0.52), 0.52, 1e-12);
    EXPECT_NEAR(begun(1.48), 1.48, 1e-12);
}

}  // namespace
