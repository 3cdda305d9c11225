// The exact responses: the multi-precision oracle against published values, the fast one against the oracle.
#include "drive/response.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/failure.hpp"
#include "drive/exact_step_response.hpp"
#include "drive/inverse_laplace.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Model;

// Step response of (12) without its dead time, by Talbot's method in 50 digits and, to 2 s, by the Mittag-Leffler
// series in 90: both agree in all of these.
struct Known {
    double t_s;
    const char* digits;
};
constexpr Known known[] = {
    {0.001, "2.94128915778730626e-6"}, {0.01, "2.85057556271580179e-4"}, {0.1, "0.0250885673516995016"},
    {0.25, "0.129455821227154699"},    {0.5, "0.375940553423532329"},    {0.75, "0.613178259304225926"},
    {1.0, "0.79280738172774321"},      {1.5, "0.973167579701079693"},    {2.0, "1.0119932474053863"},
    {3.0, "0.999400058443313765"},     {4.0, "0.996322242433827299"},    {5.0, "0.997714465898579909"},
    {10.0, "0.999486138627598309"},
};

TEST(ExactStepResponse, MatchesTheKnownValuesToTwelveDigits) {
    Model model = plants::niopdt();
    model.delay_s = 0.0;
    for (const Known& value : known) {
        const double expected = std::stod(value.digits);
        const drive::ExactValue found = drive::exact_step_response(model, value.t_s);
        EXPECT_NEAR(found.value, expected, 2e-15 * expected) << value.t_s << " s: " << found.digits;
        EXPECT_GE(found.agreed_digits, 18);
    }
}

// The digits in which two runs agree, as many as were asked for at least, and no others.
TEST(ExactStepResponse, SaysTheDigitsThatAgree) {
    Model model = plants::niopdt();
    model.delay_s = 0.0;
    for (const int wanted : {1, 18, 30, 40}) {
        const drive::ExactValue found = drive::exact_step_response(model, 0.5, wanted);
        EXPECT_GE(found.agreed_digits, wanted);
        EXPECT_LE(found.agreed_digits, 40);
        EXPECT_EQ(found.digits.size(), 2U + static_cast<std::size_t>(found.agreed_digits)) << found.digits;
        EXPECT_NEAR(std::stod(found.digits), 0.375940553423532329, 1e-15);
    }
    const drive::ExactValue before = drive::exact_step_response(plants::niopdt(), 0.5);
    EXPECT_EQ(before.digits, "0");
    EXPECT_EQ(before.agreed_digits, 40);
    EXPECT_THROW((void)drive::exact_step_response(model, std::nan("")), glsum::Failure);
}

TEST(ExactStepResponse, WaitsForTheDeadTime) {
    EXPECT_EQ(drive::exact_step_response(plants::niopdt(), 1.0).value, 0.0);
    EXPECT_NEAR(drive::exact_step_response(plants::niopdt(), 1.5).value, 0.375940553423532329, 1e-15);
}

TEST(ExactStepResponse, RefusesWhatDoesNotConverge) {
    Model swinging;
    swinging.denominator = {{1.0, 2.0}, {0.001, 1.0}, {1.0, 0.0}};
    EXPECT_THROW((void)drive::exact_step_response(swinging, 5000.0), glsum::Failure);
}

// The closed forms of (10) and (11), and of a lightly damped oscillation.
TEST(ExactStepResponse, MatchesClosedForms) {
    for (const double t : {0.01, 0.5, 3.0, 12.0}) {
        const double first = 1.0 - std::exp(-t / 0.4934);
        EXPECT_NEAR(drive::exact_step_response(drive::make_fopdt(1, 0.4934, 0), t).value, first, 1e-15);
        const double second = 1.0 - (1.0 + t / 0.319) * std::exp(-t / 0.319);
        EXPECT_NEAR(drive::exact_step_response(drive::make_sopdt(1, 0.319, 0), t).value, second, 1e-15);
    }
}

TEST(StepResponse, IsTheOracleToNineDigits) {
    Model half;  // 1 / (s^0.5 + 1), its slope infinite at 0
    half.denominator = {{1.0, 0.5}, {1.0, 0.0}};
    Model swinging;
    swinging.denominator = {{1.0, 2.0}, {0.1, 1.0}, {1.0, 0.0}};
    Model zeros;
    zeros.numerator = {{30.0, 1.0}, {90.0, 0.3}, {3.0, 0.0}};
    zeros.denominator = {{8.0, 3.1}, {26.0, 2.3}, {73.0, 1.2}, {90.0, 0.5}};
    for (const Model& model : {plants::fopdt(), plants::sopdt(), plants::niopdt(), half, swinging, zeros}) {
        drive::StepResponse step(model);
        for (double t = 1e-3; t < 60.0; t *= 1.37) {
            const double expected = drive::exact_step_response(model, t + model.delay_s, 14).value;
            EXPECT_NEAR(step(t + model.delay_s), expected, 2e-9 * std::max(1e-3, std::fabs(expected)))
                << drive::to_text(model) << " at " << t;
        }
    }
}

// A swing that is alone is followed for about 9000 turns; its frequency is known to some roundings.
TEST(StepResponse, FollowsThousandsOfSwings) {
    constexpr double damping = 5e-6;
    Model swinging;
    swinging.denominator = {{1.0, 2.0}, {2.0 * damping, 1.0}, {1.0, 0.0}};
    drive::StepResponse step(swinging);
    const double w = std::sqrt(1.0 - damping * damping);
    for (const double t : {0.3, 2.0, 30.0, 1000.0, 10000.0, 25000.0}) {
        const double expected = 1.0 - std::exp(-damping * t) * (std::cos(w * t) + damping / w * std::sin(w * t));
        EXPECT_NEAR(step(t), expected, 2e-9 * std::max(1.0, 1e-4 * t)) << t;
    }
    EXPECT_THROW((void)step(40000.0), glsum::Failure);
}

// What grows may grow to a thousand by the end of its octave of time: here [1, 2) s.
TEST(InverseLaplace, OfWhatGrowsIsExactUpToAThousand) {
    const auto growing = [](double per_s, std::vector<drive::Swing> swings) {
        return drive::InverseLaplace(
            1, [=](std::complex<double> s, std::span<std::complex<double>> values) { values[0] = 1.0 / (s - per_s); },
            std::move(swings));
    };
    const double limit = 0.5 * std::log(1e3);
    const double below = limit * (1.0 - 5e-4);
    // The one that grows fastest counts, whatever else there is.
    drive::InverseLaplace found = growing(below, {{0.0, 2.0}, {0.0, -below}, {0.0, 1.0}});
    for (const double t : {1.0, 1.3, 1.999}) {
        EXPECT_NEAR(found(t) / std::exp(below * t), 1.0, 2e-9) << t;
    }
    EXPECT_EQ(found(0.0), 0.0);
    EXPECT_EQ(found(-1.0), 0.0);
    const double above = limit * (1.0 + 5e-4);
    EXPECT_THROW((void)growing(above, {{0.0, -above}})(1.3), glsum::Failure);
    // An octave before it is still small.
    EXPECT_NEAR(growing(above, {{0.0, -above}})(0.9) / std::exp(above * 0.9), 1.0, 2e-9);
}

// A swing that cannot be taken out, since its image is known right of the axis only, is looked for with 1.5 terms for
// each half turn until the octave's end, 1024 at most: whatever the function, here e^-t, a faster one could be in it
// unseen.
TEST(InverseLaplace, LooksForSwingsWithAThousandTerms) {
    const auto at_one = [](double terms) {
        const double fastest = terms * std::numbers::pi / (1.5 * 2.0);
        return drive::InverseLaplace(1,
                                     [](std::complex<double> s, std::span<std::complex<double>> values) {
                                         values[0] = s.real() > 0.0 ? 1.0 / (s + 1.0) : std::nan("");
                                     },
                                     {{fastest, 0.0}})(1.0);
    };
    EXPECT_NEAR(at_one(1024.5), std::exp(-1.0), 1e-9);
    EXPECT_THROW((void)at_one(1025.5), glsum::Failure);
}

// What is no number, or grows beyond a thousand, is said with the beginning of its octave of time.
TEST(InverseLaplace, SaysWhereItDoesNotConverge) {
    const auto said = [](double value, std::vector<drive::Swing> swings, double t) -> std::string {
        drive::InverseLaplace found(
            1, [=](std::complex<double>, std::span<std::complex<double>> values) { values[0] = value; },
            std::move(swings));
        try {
            return std::to_string(found(t));
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::check_failed);
            return failure.what();
        }
    };
    const std::string end = " s does not converge: too lightly damped, or unstable, for so long a record";
    EXPECT_EQ(said(std::nan(""), {}, 5.0), "the response around 4" + end);
    EXPECT_EQ(said(0.0, {{0.0, -10.0}}, 3.0), "the response around 2" + end);
    EXPECT_EQ(said(0.0, {}, 3.0), "0.000000");
}

// Several transforms at once, each by its closed form, over many octaves.
TEST(InverseLaplace, OfSeveralTransformsIsEachOnesFunction) {
    drive::InverseLaplace several(3,
                                  [](std::complex<double> s, std::span<std::complex<double>> values) {
                                      values[0] = 1.0 / (s + 2.0);
                                      values[1] = 1.0 / std::sqrt(s);
                                      values[2] = s / (s * s + 0.2 * s + 1.01);
                                  },
                                  {{1.0, 0.1}});
    std::array<double, 3> now{};
    for (double t = 1e-4; t < 40.0; t *= 1.7) {
        several.at(t, now);
        EXPECT_NEAR(now[0], std::exp(-2.0 * t), 2e-9) << t;
        EXPECT_NEAR(now[1] * std::sqrt(std::numbers::pi * t), 1.0, 2e-9) << t;
        EXPECT_NEAR(now[2], std::exp(-0.1 * t) * (std::cos(t) - 0.1 * std::sin(t)), 2e-9) << t;
    }
    several.at(0.0, now);
    EXPECT_EQ(now, (std::array<double, 3>{}));
}

// What is left of a swing's square by then is below what rounding leaves of its image, which is large there.
TEST(InverseLaplace, OfASwingThatHasDecayedIsAsExactAsRoundingLetsIt) {
    constexpr double w = 6.0;
    for (const double decay : {0.3, 0.6, 0.9, 1.2}) {
        drive::InverseLaplace found(1,
                                    [=](std::complex<double> s, std::span<std::complex<double>> values) {
                                        const std::complex<double> about = (s + decay) * (s + decay) + w * w;
                                        values[0] = 2.0 * w * (s + decay) / (about * about);
                                    },
                                    {{w, decay}});
        const double largest = 1.0 / (decay * std::numbers::e);
        for (double t = 0.7; t < 60.0; t *= 1.3) {
            EXPECT_NEAR(found(t), t * std::exp(-decay * t) * std::sin(w * t), 2e-9 * largest) << decay << ' ' << t;
        }
    }
}

TEST(Respond, SuperposesHeldSteps) {
    const Model model = drive::make_fopdt(2.0, 0.5, 0.3);
    const std::vector<double> times{0.0, 1.0, 2.0, 3.0};
    const std::vector<double> input{0.0, 1.0, 1.0, -0.5};
    const auto changes = drive::changes_of(times, input);
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[1].size, -1.5);
    const std::vector<double> at{0.5, 1.3, 1.8, 3.25, 3.8};
    const auto output = drive::respond(model, changes, at);
    const auto step = [](double t) { return t <= 0 ? 0.0 : 2.0 * (1.0 - std::exp(-t / 0.5)); };
    for (std::size_t i = 0; i < at.size(); ++i) {
        EXPECT_NEAR(output[i], step(at[i] - 1.3) - 1.5 * step(at[i] - 3.3), 1e-9);
    }
}

}  // namespace
