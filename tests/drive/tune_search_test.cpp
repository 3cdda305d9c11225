// Controllers found for wishes: they meet them by a dense sweep, nothing near is better, and what cannot be is said.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "base/failure.hpp"
#include "drive/tune/search.hpp"
#include "drive/tune/tune.hpp"
#include "drive/tune/tune_picture.hpp"
#include "drive/tune/tune_report.hpp"
#include "tests/drive/plants.hpp"

namespace {

using tune::Request;
using tune::Tuned;

Request with_margin(double degrees, double crossover, double h) {
    Request request;
    request.margin_deg = degrees;
    request.crossover = crossover;
    request.sample_time_s = h;
    return request;
}

drive::Model motor() {  // 1 / (s (0.4 s + 1))
    drive::Model model;
    model.denominator = {{0.4, 2.0}, {1.0, 1.0}};
    return model;
}

std::string said(const drive::Model& plant, const Request& request) {
    try {
        (void)tune::tune(plant, request, "plant");
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "nothing";
}

TEST(Tune, MarginAndCrossoverOnAFopdt) {
    const Tuned tuned = tune::tune(plants::fopdt(), with_margin(60.0, 0.6, 0.01), "plant");
    ASSERT_TRUE(tuned.fractional && tuned.integer);
    for (const tune::Design* design : {&*tuned.fractional, &*tuned.integer}) {
        EXPECT_NEAR(design->margins.phase_deg, 60.0, 0.1);
        EXPECT_NEAR(design->margins.crossover, 0.6, 1e-3);
        EXPECT_EQ(design->margins.unstable_poles, 0);
        EXPECT_LE(design->margins.sensitivity, 2.001);
        EXPECT_GT(design->controller.gains.ki, 0.0);
        EXPECT_GE(design->controller.gains.kd, -1e-9);
    }
    // Unless it is said, the load is half of what holds the set point of 1 against the plant's gain.
    EXPECT_DOUBLE_EQ(tuned.trial.load, 0.5 / drive::static_gain(plants::fopdt()));
    EXPECT_EQ(tuned.integer->controller.gains.integral_order, 1.0);
    EXPECT_EQ(tuned.integer->controller.gains.derivative_order, 1.0);
    // A dead time of twice the lag: what the literature says of such plants, and so does the command.
    EXPECT_LT(tuned.saving(), tune::worthwhile_saving);
    EXPECT_NE(conclusion(tuned).find("The fraction buys nothing"), std::string::npos) << conclusion(tuned);
    drive::check_fopid(tuned.fractional->controller, "pid");
}

TEST(Tune, FlatPhaseKeepsTheMargin) {
    const Tuned tuned = tune::tune(motor(), with_margin(50.0, 10.0, 0.01), "plant");
    ASSERT_TRUE(tuned.fractional && tuned.integer);
    EXPECT_TRUE(tuned.fractional->flat);
    EXPECT_FALSE(tuned.integer->flat);
    EXPECT_GE(tuned.fractional->controller.gains.kp, -1e-6);  // one of the gains that it would like below 0
    EXPECT_NEAR(tuned.fractional->margins.phase_slope, 0.0, 1e-3);
    EXPECT_LT(std::fabs(tuned.fractional->weak_deg - 50.0), 2.0);
    EXPECT_GT(std::fabs(tuned.integer->weak_deg - 50.0), 4.0);
    EXPECT_NE(conclusion(tuned).find("has a flat phase, which no integer PID"), std::string::npos);
}

// Where both are flat, the integer PID that need not be stands beside them.
TEST(Tune, RivalsAtTheirBest) {
    const Tuned tuned = tune::tune(motor(), with_margin(60.0, 2.0, 0.01), "plant");
    ASSERT_TRUE(tuned.fractional && tuned.integer && tuned.steep);
    EXPECT_TRUE(tuned.integer->flat);
    EXPECT_LE(tuned.steep->load_iae, tuned.integer->load_iae);
    EXPECT_LE(tuned.fractional->load_iae, tuned.integer->load_iae);
    EXPECT_NE(to_text(tuned, "plant").find("integer, steep"), std::string::npos);
}

TEST(Tune, LeastErrorWithinASensitivity) {
    Request request;
    request.sensitivity = 1.6;
    request.sample_time_s = 0.01;
    const Tuned tuned = tune::tune(plants::fopdt(), request, "plant");
    ASSERT_TRUE(tuned.fractional && tuned.integer);
    EXPECT_NEAR(tuned.integer->margins.sensitivity, 1.6, 0.01);
    EXPECT_LE(tuned.integer->margins.sensitivity, 1.6008);
    EXPECT_LE(tuned.fractional->load_iae, tuned.integer->load_iae * (1.0 + 1e-9));
    // No gains near, or far, have less error within the same |S|: asked of the sweep, not of the grid.
    const tune::SampledPlant plant(plants::fopdt(), 0.01, "plant");
    const tune::LoadError load(plant, tuned.trial.until_s);
    const drive::Gains best = tuned.integer->controller.gains;
    std::mt19937 chance(3);
    std::uniform_real_distribution<double> spread(-1.0, 1.0);
    for (int i = 0; i < 400; ++i) {
        const double width = i % 2 == 0 ? 0.1 : 0.7;
        drive::Gains other = best;
        other.kp *= std::exp(width * spread(chance));
        other.ki *= std::exp(width * spread(chance));
        other.kd *= std::exp(width * spread(chance));
        if (load.iae(other) < 0.995 * tuned.integer->load_iae) {
            const tune::Margins margins = tune::margins_of({&plant, other});
            EXPECT_FALSE(margins.stable() && margins.sensitivity <= 1.6)
                << other.kp << ' ' << other.ki << ' ' << other.kd;
        }
    }
}

TEST(Tune, APlantOfTheOtherSign) {
    drive::Model plant = plants::fopdt();
    plant.gain = -1.0;
    const Tuned tuned = tune::tune(plant, with_margin(60.0, 0.6, 0.01), "plant");
    ASSERT_TRUE(tuned.integer);
    EXPECT_LT(tuned.integer->controller.gains.ki, 0.0);
    EXPECT_NEAR(tuned.integer->margins.phase_deg, 60.0, 0.1);
    EXPECT_EQ(tuned.integer->margins.unstable_poles, 0);
}

TEST(Tune, SaysWhatCouldBeReached) {
    const Tuned tuned = tune::tune(plants::fopdt(), with_margin(60.0, 5.0, 0.01), "plant");
    EXPECT_FALSE(tuned.fractional || tuned.integer);
    const auto at = tuned.nearest.find("--crossover ");
    ASSERT_NE(at, std::string::npos) << tuned.nearest;
    const double reached = std::stod(tuned.nearest.substr(at + 12));
    EXPECT_LT(reached, 5.0);
    const Tuned again = tune::tune(plants::fopdt(), with_margin(60.0, 0.99 * reached, 0.01), "plant");
    EXPECT_TRUE(again.fractional || again.integer) << reached;
}

TEST(Tune, RefusesContradictions) {
    Request request = with_margin(30.0, 0.6, 0.01);
    request.sensitivity = 1.5;
    EXPECT_NE(said(plants::fopdt(), request).find("contradict each other: that margin has |S| = 1.93"),
              std::string::npos);
    request = with_margin(60.0, 0.6, 0.01);
    request.low = 1.0;
    request.high = 1.0;
    EXPECT_NE(said(plants::fopdt(), request).find("--low 1 and --high 1 contradict each other"), std::string::npos);
    request.low = 0.0;
    request.high = 0.8;
    EXPECT_NE(said(plants::fopdt(), request).find("needs an input of 1"), std::string::npos);
    request = with_margin(60.0, 200.0, 0.01);
    EXPECT_NE(said(plants::fopdt(), request).find("expected less than 157.1 rad/s"), std::string::npos);
    request = with_margin(60.0, 0.6, 0.01);
    request.margin_deg.reset();
    EXPECT_NE(said(plants::fopdt(), request).find("expected both or neither"), std::string::npos);
    Request nothing;
    nothing.sample_time_s = 0.01;
    EXPECT_NE(said(plants::fopdt(), nothing).find("expected --margin DEGREES with"), std::string::npos);
}

TEST(Tune, DrawsAndWritesWhatWasFound) {
    Request request = with_margin(60.0, 0.6, 0.01);
    request.low = 0.0;
    request.high = 1.1;
    const Tuned tuned = tune::tune(plants::fopdt(), request, "plant");
    const std::string script = picture_of(tuned, "plant").script;
    EXPECT_NE(script.find("title \"" + conclusion(tuned) + "\\nplant: "), std::string::npos) << "the message is on top";
    EXPECT_LT(script.find("set key bottom left"), script.find("unset key")) << "one key serves all panels";
    EXPECT_EQ(script.find("set key", script.find("unset key") + 3), std::string::npos);
    for (const char* word : {"$ffractional", "$finteger", "$tfractional", "open loop: phase", "|S|"}) {
        EXPECT_NE(script.find(word), std::string::npos) << word;
    }
    EXPECT_NE(to_json(tuned, "m.json").find("\"schema\": \"glsum-tune-1\""), std::string::npos);
    EXPECT_TRUE(tuned.integer->course.limited);
}

// What keeps gains from being an answer, the worst the highest: a sign that is not the plant's, poles that are
// unstable, a margin short by more than 0.02 rad or an |S| a fifth too high. What is less goes through.
TEST(Search, RanksWhatKeepsGainsFromBeingAnAnswer) {
    for (const double sign : {1.0, -1.0}) {
        drive::Model model = plants::fopdt();
        model.gain = sign;
        const tune::SampledPlant plant(model, 0.01, "plant");
        const tune::Search search(plant, 0.05, 20.0);
        const drive::Gains gains{.kp = 0.2 * sign, .ki = 0.3 * sign, .filter_s = 0.05};
        const auto answer = tune::Grid(plant)(gains);
        ASSERT_EQ(answer.unstable_poles, 0);
        const auto trouble = [&](double margin_rad, double sensitivity, drive::Gains of) {
            return search.trouble_of({.crossover = 1.0, .margin_rad = margin_rad, .sensitivity = sensitivity}, of, 1.0);
        };
        const auto size = [&](const drive::Gains& of) { return trouble(0.0, 100.0, of).size; };
        EXPECT_EQ(size(gains), 0.0);
        EXPECT_NEAR(trouble(0.0, answer.sensitivity / 1.5, gains).excess, 0.5, 1e-12);
        // A margin that is short, |S| that is high, or both.
        const double s = answer.sensitivity;
        EXPECT_EQ(trouble(answer.phase_rad + 0.0199, s / 1.199, gains).size, 0.0);
        EXPECT_NEAR(trouble(answer.phase_rad + 0.0201, s / 0.5, gains).size, 1e3 * 1.0201, 1e-6);
        EXPECT_NEAR(trouble(answer.phase_rad - 1.0, s / 1.201, gains).size, 1e3 * 1.201, 1e-6);
        EXPECT_NEAR(trouble(answer.phase_rad + 0.5, s / 1.3, gains).size, 1e3 * 1.8, 1e-6);
        EXPECT_NEAR(search.trouble_of({{}, {}, s / 1.1}, gains, 1.0).excess, 0.1, 1e-12);
        // Unstable by a pair, or by two.
        drive::Gains strong = gains;
        strong.kp = 3.0 * sign;
        const int poles = tune::Grid(plant)(strong).unstable_poles;
        ASSERT_GT(poles, 0);
        EXPECT_EQ(size(strong), 1e4 * (1.0 + poles));
        // Gains of the other sign by their share of all three; none of an integral is one.
        drive::Gains wrong = gains;
        wrong.kp = -0.1 * sign;
        EXPECT_NEAR(size(wrong), 1e5 * (1.0 + 0.1 / 0.4), 1.0);
        wrong = gains;
        wrong.kd = -0.5 * sign;
        EXPECT_NEAR(size(wrong), 1e5 * (1.0 + 0.5 / 1.0), 200.0);  // through its filter
        wrong = gains;
        wrong.ki = 0.0;
        EXPECT_NEAR(size(wrong), 1e5 * (1.0 + 1e-6), 1e-3);
        wrong.ki = 0.9e-6 * wrong.kp;
        EXPECT_GT(size(wrong), 1e5);
        wrong.ki = 1.1e-6 * wrong.kp;
        EXPECT_LT(size(wrong), 1e5);
        // Rounding is no sign.
        wrong = gains;
        wrong.kd = -0.4e-9 * sign;
        EXPECT_LT(size(wrong), 1e5);
        wrong.kd = -0.6e-9 * sign;
        EXPECT_GT(size(wrong), 1e5);
    }
}

// The three gains are weighed by what they make of the frequency that is asked: D = (1 - e^(-jwh)) / h is 2 sin(wh / 2)
// / h there, and the derivative's filter takes its part.
TEST(Search, WeighsGainsWhereItIsAsked) {
    const tune::SampledPlant plant(plants::fopdt(), 0.01, "plant");
    const tune::Search search(plant, 0.05, 20.0);
    const double w = 4.0;
    const double size = 2.0 * std::sin(0.5 * w * 0.01) / 0.01;
    const std::complex<double> difference = (1.0 - std::polar(1.0, -w * 0.01)) / 0.01;
    const double integral = 0.3 * std::pow(size, -0.8);
    const double derivative = 0.5 * std::pow(size, 0.6) / std::abs(1.0 + 0.05 * difference);
    const auto trouble = [&](double kp, double ki, double kd) {
        const drive::Gains gains{
            .kp = kp, .ki = ki, .kd = kd, .filter_s = 0.05, .integral_order = 0.8, .derivative_order = 0.6};
        return search.trouble_of({{}, {}, 100.0}, gains, w).size;
    };
    const double all = 0.2 + integral + derivative;
    EXPECT_NEAR(trouble(-0.2, 0.3, 0.5), 1e5 * (1.0 + 0.2 / all), 1e-4);
    EXPECT_NEAR(trouble(0.2, -0.3, 0.5), 1e5 * (1.0 + integral / all + 1e-6), 1e-4);
    EXPECT_NEAR(trouble(0.2, 0.3, -0.5), 1e5 * (1.0 + derivative / all), 1e-4);
    // A billionth of them all is rounding.
    const double rounding = 1e-9 * (0.2 + integral) * 0.5 / derivative;
    EXPECT_LT(trouble(0.2, 0.3, -0.995 * rounding), 1e5);
    EXPECT_GT(trouble(0.2, 0.3, -1.005 * rounding), 1e5);
}

TEST(Search, TheSweepHasTheLastWord) {
    const tune::Wish wish{.crossover = 2.0, .margin_rad = 1.0, .sensitivity = 1.6};
    tune::Margins margins;
    const auto is_met = [&](double margin_rad, double crossover, double sensitivity) {
        margins.phase_deg = margin_rad * 180.0 / tune::pi;
        margins.crossover = crossover;
        margins.sensitivity = sensitivity;
        return tune::meets(wish, margins);
    };
    EXPECT_TRUE(is_met(1.0, 2.0, 1.6));
    for (const double side : {-1.0, 1.0}) {
        EXPECT_TRUE(is_met(1.0 + side * 0.00995, 2.0, 1.6));
        EXPECT_FALSE(is_met(1.0 + side * 0.01005, 2.0, 1.6));
        EXPECT_TRUE(is_met(1.0, 2.0 * (1.0 + side * 0.000995), 1.6));
        EXPECT_FALSE(is_met(1.0, 2.0 * (1.0 + side * 0.001005), 1.6));
    }
    // At the limits themselves it is not.
    EXPECT_FALSE(is_met(1.0, 2.0, 1.0005 * 1.6));
    margins.sensitivity = 1.6;
    margins.phase_deg = 0.0;
    EXPECT_FALSE(tune::meets({.crossover = 2.0, .margin_rad = 0.01, .sensitivity = 1.6}, margins));
    EXPECT_TRUE(is_met(1.0, 2.0, 1.6 * 1.000499));
    EXPECT_FALSE(is_met(1.0, 2.0, 1.6 * 1.000501));
    // Without a margin whatever the loop has.
    margins.phase_deg = 10.0;
    margins.crossover = 77.0;
    margins.sensitivity = 1.6;
    EXPECT_TRUE(tune::meets({{}, {}, 1.6}, margins));
    for (const int poles : {-1, 2}) {
        margins.unstable_poles = poles;
        EXPECT_FALSE(tune::meets({{}, {}, 1.6}, margins));
        EXPECT_FALSE(is_met(1.0, 2.0, 1.0));
    }
}

// Gains that are known are the answer where none are found, or none that leave less, with a phase as flat.
TEST(Search, IsNeverWorseThanWhatItIsToldOf) {
    const tune::SampledPlant plant(motor(), 0.01, "plant");
    const tune::Search search(plant, 0.02, 20.0);
    const tune::Wish wish{.crossover = 2.0, .margin_rad = 1.05, .sensitivity = 2.0};
    const auto alone = search.best(wish, tune::Orders::integer);
    ASSERT_TRUE(alone && alone->flat);
    const auto beside = [&](double iae, bool flat, const tune::Wish& of) {
        return search.best(of, tune::Orders::integer, tune::Found{{.kp = 77.0}, flat, iae, 0});
    };
    EXPECT_EQ(beside(1.001 * alone->iae, true, wish)->gains.kp, alone->gains.kp);
    EXPECT_EQ(beside(alone->iae, true, wish)->gains.kp, alone->gains.kp);
    const auto better = beside(0.999 * alone->iae, true, wish);
    EXPECT_EQ(better->gains.kp, 77.0);
    EXPECT_EQ(better->iae, 0.999 * alone->iae);
    EXPECT_TRUE(better->flat);
    EXPECT_EQ(better->tries, alone->tries);
    EXPECT_EQ(beside(0.5 * alone->iae, false, wish)->gains.kp, alone->gains.kp);
    tune::Wish none = wish;
    none.sensitivity = 0.5;
    EXPECT_EQ(beside(1e6, true, none)->gains.kp, 77.0);
}

}  // namespace
