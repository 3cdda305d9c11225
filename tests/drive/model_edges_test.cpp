// Models, controllers and what is sealed, at the edges of what is taken and field by field.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "drive/closed_loop.hpp"
#include "drive/commensurate.hpp"
#include "drive/controller.hpp"
#include "drive/form.hpp"
#include "drive/kernel_sum.hpp"
#include "drive/real_transform.hpp"
#include "drive/realtime.hpp"
#include "drive/realtime_controller.hpp"
#include "drive/simulation.hpp"
#include "drive/stability.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/without_model.hpp"
#include "drive/swings.hpp"
#include "glsum/registry.hpp"
#include "glsum/weights.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Model;
using drive::Term;
using nlohmann::json;
using testing::HasSubstr;

std::string refusal_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "accepted";
}

std::string checked(const Model& model) {
    return refusal_of([&] { drive::check_model(model, "m"); });
}

TEST(ModelEdges, AreTakenUpToTheirBounds) {
    Model model = drive::make_fopdt(1.0, 0.5, 0.0);
    EXPECT_EQ(checked(model), "accepted");
    model.delay_s = 1e6;
    EXPECT_EQ(checked(model), "accepted");
    model.delay_s = std::nextafter(1e6, 2e6);
    EXPECT_THAT(checked(model), HasSubstr("delay_s: expected 0 to 1000000 s"));
    model.delay_s = -1e-300;
    EXPECT_THAT(checked(model), HasSubstr("delay_s"));
    model = drive::make_fopdt(1.0, 0.5, 0.0);
    model.denominator[0].order = 20.0;
    EXPECT_EQ(checked(model), "accepted");
    model.denominator[0].order = std::nextafter(20.0, 21.0);
    EXPECT_THAT(checked(model), HasSubstr("denominator[0].order: expected 0 to 20"));
    model = drive::make_fopdt(1.0, 0.5, 0.0);
    model.numerator = {{1.0, 1.0}};
    EXPECT_EQ(checked(model), "accepted");  // as many derivatives of the input as of the output
    model.numerator = {{1.0, std::nextafter(1.0, 2.0)}};
    EXPECT_THAT(checked(model), HasSubstr("improper"));
    model.numerator = {{1.0, 0.0}};
    model.denominator.clear();
    for (int i = 0; i < 64; ++i) {
        model.denominator.push_back({1.0, 0.25 * i});
    }
    EXPECT_EQ(checked(model), "accepted");
    model.denominator.push_back({1.0, 16.5});
    EXPECT_THAT(checked(model), HasSubstr("expected 1 to 64 terms, found 65"));
    model = drive::make_fopdt(1.0, 0.5, 0.0);
    model.sample_time_s = std::numeric_limits<double>::infinity();
    EXPECT_THAT(checked(model), HasSubstr("sample_time_s"));
    model.sample_time_s = 1e-300;
    EXPECT_EQ(checked(model), "accepted");
    model.gain = std::numeric_limits<double>::infinity();
    EXPECT_THAT(checked(model), HasSubstr("gain"));
}

TEST(ModelEdges, HaveTheGainAndTheTextOfTheirFractions) {
    Model model;
    model.gain = 3.0;
    model.numerator = {{2.0, 0.0}, {1.0, 0.5}};
    model.denominator = {{-1.0, 1.5}, {4.0, 0.0}};
    EXPECT_EQ(drive::static_gain(model), 1.5);
    EXPECT_EQ(drive::to_text(model), "3 (s^0.5 + 2) / (-s^1.5 + 4)");
    model.denominator = {{1.0, 1.0}};
    EXPECT_EQ(drive::static_gain(model), std::numeric_limits<double>::infinity());
    model.gain = -3.0;
    EXPECT_EQ(drive::static_gain(model), -std::numeric_limits<double>::infinity());
    model.numerator = {{1.0, 1.0}};
    EXPECT_EQ(drive::static_gain(model), 0.0);
    EXPECT_EQ(drive::to_text(model), "-3 s / s");
    EXPECT_EQ(drive::to_text(drive::make_sopdt(2.0, 0.5, 0.25)), "2 / (0.25 s^2 + s + 1) exp(-0.25 s)");
    EXPECT_EQ(drive::to_text(drive::make_fopdt(1.0, -0.5, 0.0)), "1 / (-0.5 s + 1)");
}

TEST(ControllerEdges, OrdersAndFiltersAreTakenUpToTheirBounds) {
    const auto made = [](const drive::Gains& gains) { return refusal_of([&] { (void)drive::to_model(gains, "c"); }); };
    EXPECT_EQ(made({.kp = 1.0, .ki = 1.0, .integral_order = std::nextafter(2.0, 1.0)}), "accepted");
    EXPECT_THAT(made({.kp = 1.0, .ki = 1.0, .integral_order = 2.0}), HasSubstr("integral_order"));
    EXPECT_THAT(made({.kp = 1.0, .ki = 1.0, .integral_order = 0.0}), HasSubstr("integral_order"));
    EXPECT_EQ(made({.kp = 1.0, .kd = 1.0, .filter_s = 0.1, .derivative_order = 1.0}), "accepted");
    EXPECT_THAT(made({.kp = 1.0, .kd = 1.0, .filter_s = 0.1, .derivative_order = std::nextafter(1.0, 2.0)}),
                HasSubstr("derivative_order"));
    EXPECT_THAT(made({.kp = 1.0, .derivative_order = 0.0}), HasSubstr("derivative_order"));
    EXPECT_THAT(made({.kp = 1.0, .filter_s = -0.1}), HasSubstr("filter_s"));
    EXPECT_EQ(made({.ki = 1.0}), "accepted");
    // What answers later answers nothing at once.
    Model late = drive::to_model({.kp = 3.0}, "p");
    EXPECT_EQ(drive::direct_gain(late), 3.0);
    late.delay_s = 0.1;
    EXPECT_EQ(drive::direct_gain(late), 0.0);
}

// Position and velocity by hand: p_j = kp (j = 0) + ki h + kd h^-1 (1, -1, 0, ...), and their differences.
TEST(ControllerEdges, NumbersOfAPidAreThoseByHand) {
    constexpr double h = 0.01;
    const drive::RealtimeController pi({.kp = 0.5, .ki = 2.0}, {4}, h, 100);
    EXPECT_NEAR(pi.design().first, 0.5 + 2.0 * h, 1e-15);
    ASSERT_EQ(pi.design().ratios.size(), 3U);
    EXPECT_NEAR(pi.design().ratios[0], -0.5 / 0.52, 1e-13);
    EXPECT_NEAR(pi.design().ratios[1], 0.0, 1e-13);
    EXPECT_NEAR(pi.design().ratios[2], 0.0, 1e-13);
    EXPECT_NEAR(pi.error(), 0.0, 1e-12);
    EXPECT_EQ(pi.memory().text(), "4");
    EXPECT_EQ(pi.design().low, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(pi.design().high, std::numeric_limits<double>::infinity());
    const drive::RealtimeController pd({.kp = 0.5, .kd = 0.03}, {3}, h, 100);
    EXPECT_NEAR(pd.design().first, 0.5 + 3.0, 1e-13);
    EXPECT_NEAR(pd.design().ratios[0], (-3.0 - 3.5) / 3.5, 1e-13);
    EXPECT_NEAR(pd.design().ratios[1], 3.0 / 3.5, 1e-13);
    // A fractional integral: what is cut off stands still at its last weight.
    const drive::RealtimeController half({.ki = 2.0, .integral_order = 0.5}, {5}, h, 40);
    glsum::Weights weights(-0.5);
    std::vector<double> position;
    for (int j = 0; j <= 40; ++j) {
        position.push_back(2.0 * std::sqrt(h) * weights.weight());
        weights.next();
    }
    EXPECT_NEAR(half.design().first, position[0], 1e-15);
    double cut = 0.0;
    for (std::size_t j = 1; j < 5; ++j) {
        EXPECT_NEAR(half.design().ratios[j - 1], (position[j] - position[j - 1]) / position[0], 1e-13);
    }
    for (std::size_t j = 5; j <= 40; ++j) {
        cut += std::fabs(position[j] - position[4]);
    }
    EXPECT_NEAR(half.error(), cut, 1e-12);
    // Two taps and modes are one too few, three are enough.
    EXPECT_EQ(refusal_of([&] {
                  drive::RealtimeController({.ki = 1.0, .integral_order = 0.5}, {3 + 2 * 4, 4}, h, 500);
              }),
              "accepted");
    EXPECT_THAT(refusal_of([&] {
                    drive::RealtimeController({.ki = 1.0, .integral_order = 0.5}, {2 + 2 * 4, 4}, h, 500);
                }),
                HasSubstr("at least 3 taps before the modes"));
    const drive::RealtimeController few({.ki = 1.0, .integral_order = 0.5}, {3 + 2 * 4, 4}, h, 500);
    EXPECT_EQ(few.memory().taps, 3U + 2U * 4U);
    EXPECT_EQ(few.memory().modes, 4U);
    EXPECT_EQ(few.design().ratios.size(), 2U);
}

// Full scales are powers of two with a hundredth to spare.
TEST(RealtimeEdges, ScalesHoldWhatAnInputCanMake) {
    const auto scale = [](double gain) {
        return drive::RealtimeModel(drive::make_fopdt(gain, 0.05, 0.0), drive::Writing::merged, {10}, 0.01)
            .design()
            .output_full_scale;
    };
    EXPECT_EQ(scale(1.975), 2.0);
    EXPECT_EQ(scale(1.985), 4.0);
    EXPECT_EQ(scale(0.4), 0.5);
    EXPECT_THAT(refusal_of([] {
                    drive::RealtimeModel(drive::make_fopdt(1.0, 0.05, 0.0), drive::Writing::delta, {2 + 1, 1}, 0.01);
                }),
                HasSubstr("at least 2 taps"));
    // Five orders apart are a table too many.
    Model many;
    many.denominator = {{1.0, 1.8}, {1.0, 1.5}, {1.0, 1.1}, {1.0, 0.7}, {1.0, 0.0}};
    EXPECT_EQ(refusal_of([&] { drive::RealtimeModel(many, drive::Writing::apart, {10}, 0.01); }), "accepted");
    many.denominator.push_back({1.0, 0.3});
    EXPECT_THAT(refusal_of([&] { drive::RealtimeModel(many, drive::Writing::apart, {10}, 0.01); }),
                HasSubstr("at most 4 orders, found 5"));
}

TEST(FormEdges, TheTimeConstantIsThatOfTheTermNearestToOne) {
    const auto time_constant_s = [](std::vector<Term> denominator, drive::Kind kind = drive::Kind::fopdt) {
        Model start;
        start.denominator = std::move(denominator);
        return drive::Form(kind, start).parameter("time_constant_s").value;
    };
    EXPECT_NEAR(time_constant_s({{0.5, 1.0}, {2.0, 0.0}}), 0.25, 1e-15);
    EXPECT_NEAR(time_constant_s({{0.5, 0.51}, {2.0, 0.0}}), 0.25, 1e-15);
    EXPECT_NEAR(time_constant_s({{0.5, 0.5}, {2.0, 0.0}}), 1e-6, 1e-15);  // too far from one
    EXPECT_NEAR(time_constant_s({{0.5, 1.49}, {2.0, 0.0}}), 0.25, 1e-15);
    EXPECT_NEAR(time_constant_s({{0.5, 1.5}, {2.0, 0.0}}), 1e-6, 1e-15);
    // Of a second order three quarters; 1.5 is none yet.
    EXPECT_NEAR(time_constant_s({{1.0, 1.5}, {0.5, 1.0}, {2.0, 0.0}}), 0.25, 1e-15);
    EXPECT_NEAR(time_constant_s({{1.0, 1.51}, {0.5, 1.0}, {2.0, 0.0}}), 0.1875, 1e-15);
    EXPECT_NEAR(time_constant_s({{-0.5, 1.0}, {2.0, 0.0}}), 0.25, 1e-15);  // above 0 it begins
}

TEST(CommensurateEdges, TheCommonOrderIsFoundToAMillionth) {
    const auto common = [](double a, double b) {
        Model model;
        model.denominator = {{1.0, a}, {1.0, b}, {1.0, 0.0}};
        return drive::common_base_order(model);
    };
    EXPECT_NEAR(common(1.5, 0.75).value(), 0.75, 1e-12);
    EXPECT_EQ(common(3.0, 2.0).value(), 1.0);
    EXPECT_EQ(common(4.0, 2.0).value(), 1.0);  // below 2 it must be
    EXPECT_NEAR(common(2.5, 5.0).value(), 1.25, 1e-12);
    EXPECT_NEAR(common(4.5, 4.5).value(), 1.5, 1e-12);
    EXPECT_NEAR(common(1.999999, 1.999999).value(), 1.999999, 1e-12);
    EXPECT_FALSE(common(1.2345678, 0.5).has_value());
    EXPECT_FALSE(common(1.0, 0.001).has_value());           // of degree 1000
    EXPECT_NEAR(common(0.6, 0.001).value(), 0.001, 1e-12);  // of 600
    EXPECT_FALSE(common(0.601, 0.001).has_value());
    Model constant;
    constant.denominator = {{2.0, 0.0}};
    EXPECT_EQ(drive::common_base_order(constant), 1.0);
    EXPECT_THAT(refusal_of([] { (void)drive::to_commensurate(plants::sopdt(), 2.0); }), HasSubstr("(0, 2)"));
    const auto form = drive::to_commensurate(plants::niopdt(), 0.01);
    EXPECT_NEAR(form.rounding, 0.00319, 1e-9);  // 0.98319 becomes 0.98
    EXPECT_EQ(form.denominator.size(), 200U);
    EXPECT_EQ(form.denominator[98], 0.65536);
    EXPECT_EQ(form.denominator[199], 0.18234);
}

// s^2 + 2 z w s + w^2: the swing, its frequency and decay.
TEST(Swings, AreThePolesNearTheAxis) {
    const auto swings = [](double damping) {
        return drive::swings_of({{1.0, 2.0}, {2.0 * damping * 3.0, 1.0}, {9.0, 0.0}});
    };
    for (const double damping : {0.01, 0.2, -0.1}) {
        const auto found = swings(damping);
        ASSERT_EQ(found.size(), 1U) << damping;
        EXPECT_NEAR(found[0].radians_per_s, 3.0 * std::sqrt(1.0 - damping * damping), 1e-8);
        EXPECT_NEAR(found[0].decay_per_s, 3.0 * damping, 1e-8);
    }
    EXPECT_TRUE(swings(0.9).empty());
    // Each once and none for another, however fast or slow they are.
    for (const double w : {1e-5, 1.0, 1e7}) {
        const double one = w * w;
        const double other = 9.0 * w * w;
        const double slow = 2.0 * 0.05 * w;
        const double fast = 2.0 * 0.05 * 3.0 * w;
        const auto both = drive::swings_of({{1.0, 4.0},
                                            {slow + fast, 3.0},
                                            {one + other + slow * fast, 2.0},
                                            {slow * other + fast * one, 1.0},
                                            {one * other, 0.0}});
        ASSERT_EQ(both.size(), 2U) << w;
        EXPECT_NEAR(both[0].radians_per_s / (w * std::sqrt(1.0 - 0.0025)), 1.0, 1e-7);
        EXPECT_NEAR(both[1].radians_per_s / (3.0 * w * std::sqrt(1.0 - 0.0025)), 1.0, 1e-7);
        EXPECT_NEAR(both[1].decay_per_s / (0.15 * w), 1.0, 1e-6);
    }
    EXPECT_TRUE(drive::swings_of({{1.0, 1.0}, {1.0, 0.0}}).empty());
    EXPECT_TRUE(drive::swings_of({{1.0, 1.0}}).empty());
    const std::vector<drive::Swing> two{{2.0, 1.0}, {5.0, 10.0}};
    EXPECT_EQ(drive::fastest_left(two, 0.1, 1e-3), 5.0);
    EXPECT_EQ(drive::fastest_left(two, 1.0, 1e-3), 2.0);  // e^-10 is below a thousandth
    EXPECT_EQ(drive::fastest_left(two, 10.0, 1e-3), 0.0);
    EXPECT_EQ(drive::fastest_left({{2.0, 1.0}}, 6.9, 1e-3), 2.0);
    EXPECT_EQ(drive::fastest_left({{2.0, 1.0}}, 6.92, 1e-3), 0.0);
}

TEST(SimulationEdges, DelaysAndRecordsEndWhereTheySay) {
    // A dead time between two steps is rounded up, but for what rounding left of a whole one.
    const auto first_answer = [](double delay_s) {
        const auto output =
            drive::simulate(drive::make_fopdt(1.0, 0.05, delay_s), {.step_s = 0.01}, drive::make_input({}, 0.01, 1.0))
                .output;
        return static_cast<int>(std::find_if(output.begin(), output.end(), [](double y) { return y != 0.0; }) -
                                output.begin());
    };
    EXPECT_EQ(first_answer(0.0), 1);
    EXPECT_EQ(first_answer(0.25), 26);
    EXPECT_EQ(first_answer(0.251), 27);
    EXPECT_EQ(first_answer(0.25 + 1e-12), 26);
    Model model = drive::make_fopdt(1.0, 0.5, 0.25);
    EXPECT_TRUE(drive::delay_fits(model, 0.01));
    model.delay_s = 0.2501;
    EXPECT_FALSE(drive::delay_fits(model, 0.01));
    EXPECT_EQ(drive::make_input({}, 0.1, 1.0).size(), 11U);
    EXPECT_EQ(drive::make_input({}, 1.0, 1.0).size(), 2U);
    EXPECT_THAT(refusal_of([] { (void)drive::make_input({}, 1.0, 0.99); }), HasSubstr("2 to 10^7 samples"));
    EXPECT_THAT(refusal_of([] { (void)drive::make_input({}, 1.0, 1.01e7); }), HasSubstr("2 to 10^7 samples"));
    EXPECT_THAT(refusal_of([] { (void)drive::simulate(plants::fopdt(), {.taps = 0}, std::vector<double>(3, 1.0)); }),
                HasSubstr("at least 1 tap"));
    // A staircase of one stair is a pulse of half the record; of none it is the same.
    const std::vector<double> up_and_down{1, 1, 0, 0};
    EXPECT_EQ(drive::make_input({.name = "staircase", .stairs = 1}, 1.0, 3.0), up_and_down);
    EXPECT_EQ(drive::make_input({.name = "staircase", .stairs = 0}, 1.0, 3.0), up_and_down);
}

TEST(SealedTruth, IsWrittenWithEveryField) {
    namespace blind = stand::blind;
    blind::Truth truth;
    truth.plan = {blind::Class::same, {"input_curve"}, {blind::EffectSize::clear}, true};
    truth.parameters = {{{"curvature", 0.5}}};
    truth.required = {"gain_error", "input_curve"};
    truth.allowed = {"gain_error", "input_curve", "supply_sag"};
    truth.plant = "whole";
    truth.train = "step";
    truth.validate = "on_off";
    truth.coloured = true;
    truth.noise = 0.125;
    truth.train_deviation = 3.0;
    truth.validate_deviation = 4.0;
    truth.gap_base = 0.25;
    truth.noise_floor = 0.0625;
    truth.from_s = 1.5;
    truth.to_s = 2.5;
    blind::Truth quiet;
    quiet.plan.kind = blind::Class::none;
    const json file = json::parse(blind::seal(9, {truth, quiet}));
    const json row{{"case", "001"},
                   {"class", "same"},
                   {"effects", {{{"effect", "input_curve"}, {"size", "clear"}, {"parameters", {{"curvature", 0.5}}}}}},
                   {"required", truth.required},
                   {"allowed", truth.allowed},
                   {"plant", "whole"},
                   {"train", "step"},
                   {"validate", "on_off"},
                   {"new_profile", true},
                   {"noise", {{"deviation", 0.125}, {"colour", "coloured"}}},
                   {"deviation_over_noise", {{"train", 3.0}, {"validate", 4.0}}},
                   {"gap", {{"base", 0.25}, {"noise_floor", 0.0625}}},
                   {"where", {{"time", json::array({{{"from_s", 1.5}, {"to_s", 2.5}}})}}}};
    EXPECT_EQ(file["schema"], "glsum-blind-truth-1");
    EXPECT_EQ(file["seed"], 9);
    ASSERT_EQ(file["cases"].size(), 2U);
    EXPECT_EQ(file["cases"][0], row);
    EXPECT_EQ(file["cases"][1]["case"], "002");
    EXPECT_EQ(file["cases"][1]["noise"]["colour"], "white");
    EXPECT_FALSE(file["cases"][1].contains("where"));
    EXPECT_FALSE(file["cases"][1].contains("required"));
    EXPECT_EQ(file["cases"][1]["new_profile"], false);
}

TEST(SealedTruth, WithoutAModelIsWrittenWithEveryField) {
    namespace blind = stand::blind;
    blind::OpenTruth truth;
    truth.domain = "thermal";
    truth.plan = {
        blind::Class::pair, {"rate_limit", "melting"}, {blind::EffectSize::small, blind::EffectSize::large}, false};
    truth.parameters = {{{"per_s", 0.5}}, {{"share", 2.0}}};
    truth.plant = "body";
    truth.train = {"ramp", "prbs"};
    truth.validate = {"chirp"};
    truth.noise = 0.125;
    truth.left_in_training = 7.0;
    truth.left_on_validation = 8.0;
    truth.gap_base = 0.25;
    truth.noise_floor = 0.0625;
    truth.from_s = 1.5;
    truth.to_s = 2.5;
    blind::OpenTruth quiet;
    quiet.coloured = true;
    const json file = json::parse(blind::seal_open(9, {truth, quiet}));
    const json row{{"case", "001"},
                   {"class", "pair"},
                   {"domain", "thermal"},
                   {"effects",
                    {{{"effect", "rate_limit"}, {"size", "small"}, {"parameters", {{"per_s", 0.5}}}},
                     {{"effect", "melting"}, {"size", "large"}, {"parameters", {{"share", 2.0}}}}}},
                   {"plant", "body"},
                   {"train", "ramp+prbs"},
                   {"validate", "chirp"},
                   {"noise", {{"deviation", 0.125}, {"colour", "white"}}},
                   {"left_over_noise", {{"train", 7.0}, {"validate", 8.0}}},
                   {"gap", {{"base", 0.25}, {"noise_floor", 0.0625}}},
                   {"where", {{"time", json::array({{{"from_s", 1.5}, {"to_s", 2.5}}})}}}};
    EXPECT_EQ(file["schema"], "glsum-blind-truth-1");
    EXPECT_EQ(file["base"], "fitted");
    EXPECT_EQ(file["seed"], 9);
    ASSERT_EQ(file["cases"].size(), 2U);
    EXPECT_EQ(file["cases"][0], row);
    EXPECT_EQ(file["cases"][1]["case"], "002");
    EXPECT_EQ(file["cases"][1]["noise"]["colour"], "coloured");
    EXPECT_FALSE(file["cases"][1].contains("where"));
}

// Of a fraction -1 is a sample, 1 and what lies below -1 are not.
TEST(KernelSum, CountsSamplesBeyondFullScale) {
    drive::KernelSum<glsum::Sum<glsum::Ring, glsum::Plain, glsum::Q31>> sum({0.5, 4});
    ASSERT_EQ(sum.status(), glsum::Status::ok);
    sum.push(-1.0);
    EXPECT_EQ(sum.saturations(), 0U);
    EXPECT_NEAR(sum.past(), 0.5, 1e-9);  // -a_1
    EXPECT_NEAR(sum.past(), 0.5, 1e-9);  // it was only asked
    sum.push(std::nextafter(1.0, 0.0));
    EXPECT_EQ(sum.saturations(), 0U);
    sum.push(1.0);
    EXPECT_EQ(sum.saturations(), 1U);
    sum.push(std::nextafter(-1.0, -2.0));
    EXPECT_EQ(sum.saturations(), 2U);
    drive::KernelSum<glsum::Sum<glsum::Ring, glsum::Oldest, glsum::F64>> real({0.5, 4});
    real.push(7.0);
    EXPECT_EQ(real.saturations(), 0U);
    EXPECT_NEAR(real.past(), -3.5, 1e-12);
}

TEST(RealTransform, HasHalfASpectrum) {
    drive::RealTransform::Buffer buffer(48, std::vector<double>{1.0, 2.0});
    EXPECT_EQ(buffer.reals().size(), 48U);
    EXPECT_EQ(buffer.spectrum().size(), 25U);
    const drive::RealTransform::Buffer& kept = buffer;
    EXPECT_EQ(kept.spectrum().size(), 25U);
    EXPECT_EQ(kept.reals()[1], 2.0);
    EXPECT_EQ(kept.reals()[2], 0.0);
    EXPECT_EQ(kept.reals()[47], 0.0);
}

}  // namespace
