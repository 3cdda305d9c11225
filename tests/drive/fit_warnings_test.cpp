// What a fit warns of, on either side of each limit: records are changed by little until the limit is passed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "drive/fit.hpp"
#include "drive/response.hpp"

namespace {

using drive::Fit;
using drive::Form;
using drive::Kind;
using drive::Record;

bool warns(const Fit& fit, const std::string& words) {
    return std::any_of(fit.warnings.begin(), fit.warnings.end(),
                       [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

Record stepped(const drive::Model& model, int samples, double step_s) {
    Record record;
    record.name = "step";
    record.changes = {{0.0, 1.0}};
    for (int k = 0; k < samples; ++k) {
        record.time_s.push_back(step_s * k);
    }
    record.output = drive::respond(model, record.changes, record.time_s);
    return record;
}

Form with_free(const drive::Model& model, const std::vector<std::string>& names) {
    Form form(model.denominator.size() == 2 ? Kind::fopdt : Kind::sopdt, model);
    for (drive::Parameter& parameter : form.parameters()) {
        parameter.fixed = std::find(names.begin(), names.end(), parameter.name) == names.end();
    }
    return form;
}

// A warning is there just where a quantity is above its limit: asked on both sides of it, ever nearer, to half a per
// cent. \param fit_at  a quantity that rises with x, and whether its warning is there
void expect_limit(double limit, double low, double high, const std::function<std::pair<double, bool>(double)>& fit_at) {
    double below = 0.0;
    double above = INFINITY;
    for (int turn = 0; turn < 14; ++turn) {
        const double x = 0.5 * (low + high);
        const auto [quantity, warned] = fit_at(x);
        EXPECT_EQ(warned, quantity > limit) << quantity;
        (quantity > limit ? high : low) = x;
        (quantity > limit ? above : below) = quantity;
    }
    EXPECT_LT(above, 1.005 * limit);
    EXPECT_GT(below, 0.995 * limit);
}

const drive::Model plant = drive::make_fopdt(2.0, 0.5, 0.0);

// Half of the interval over the value.
TEST(FitWarnings, ANumberWhoseIntervalIsAsWideAsItselfIsHardlyKnown) {
    const Form form = with_free(plant, {"gain"});
    const Record record = stepped(plant, 40, 0.1);
    expect_limit(0.5, 2.0, 5.0, [&](double size) {
        Record noisy = record;
        for (std::size_t k = 0; k < noisy.output.size(); ++k) {
            noisy.output[k] += k % 2 == 0 ? size : -size;
        }
        const Fit fit = drive::fit(form, {noisy}, {});
        const drive::Estimate& gain = fit.parameters[0];
        EXPECT_FALSE(warns(fit, "tell these parameters apart"));
        return std::pair(0.5 * (gain.high - gain.low) / gain.value, warns(fit, "gain: hardly known"));
    });
}

// Four deviations of white noise's.
TEST(FitWarnings, ResidualsThatRememberAreNotWhite) {
    const Form form = with_free(plant, {"gain"});
    const Record record = stepped(plant, 64, 0.1);
    for (const double sign : {1.0, -1.0}) {
        expect_limit(4.0 / std::sqrt(64.0), 0.3, 0.9, [&](double share) {
            Record noisy = record;
            for (std::size_t k = 0; k < noisy.output.size(); ++k) {
                // Of period 4, neighbours neither agree nor disagree; of 1 they agree, of 2 they do not.
                const double white = k % 4 < 2 ? 0.01 : -0.01;
                const double coloured = (k % 32 < 16 ? 0.01 : -0.01) * (sign > 0.0 || k % 2 == 0 ? 1.0 : -1.0);
                noisy.output[k] += (1.0 - share) * white + share * coloured;
            }
            const Fit fit = drive::fit(form, {noisy}, {});
            return std::pair(std::fabs(fit.lag_one), warns(fit, "the residuals are not white"));
        });
    }
}

// A record that ends before its response bends knows gain and time constant as a ratio only.
TEST(FitWarnings, NumbersThatAreKnownTogetherAreNamed) {
    const Form form = with_free(plant, {"gain", "time_constant_s"});
    expect_limit(0.995, 20.0, 400.0, [&](double samples_a_second) {
        Record noisy = stepped(plant, 40, 1.0 / samples_a_second);
        for (std::size_t k = 0; k < noisy.output.size(); ++k) {
            noisy.output[k] += k % 2 == 0 ? 1e-4 : -1e-4;
        }
        const Fit fit = drive::fit(form, {noisy}, {});
        return std::pair(std::fabs(fit.correlation(0, 1)),
                         warns(fit, "gain and time_constant_s are known together only"));
    });
}

// Within a ten-millionth of itself, or of 1.
TEST(FitWarnings, ABoundIsMetWithinATenMillionth) {
    const Record record = stepped(plant, 40, 0.1);
    for (const double away : {0.0, 0.9e-7, 1.2e-7, 1e-5}) {
        Form form = with_free(plant, {"gain"});
        form.parameter("gain").lower = 2.0 - away * 2.0;
        EXPECT_EQ(warns(drive::fit(form, {record}, {}), "gain: ends at its bound"), away < 1e-7) << away;
        form = with_free(plant, {"gain"});
        form.parameter("gain").upper = 2.0 + away * 2.0;
        EXPECT_EQ(warns(drive::fit(form, {record}, {}), "gain: ends at its bound"), away < 1e-7) << away;
    }
}

}  // namespace
