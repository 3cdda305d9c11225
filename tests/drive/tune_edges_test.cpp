// Where the frequency axis of a sampled plant and of its loops begins, ends and changes its spacing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "drive/tune/grid.hpp"
#include "drive/tune/margins.hpp"
#include "tests/drive/plants.hpp"

namespace {

using tune::Complex;
using tune::SampledPlant;
constexpr double pi = tune::pi;

drive::Model of_orders(std::vector<drive::Term> denominator, double delay_s = 0.0) {
    drive::Model model;
    model.denominator = std::move(denominator);
    model.delay_s = delay_s;
    return model;
}

// The scale is the highest of the frequencies 1e-7 * 1.02^k of a quarter of the samples' at which the phase is above
// -135 degrees. That of s^-alpha behind a hold is -alpha pi / 2 - w h / 2.
TEST(TuneEdges, TheScaleIsTheLastFrequencyOfItsGridAboveItsPhase) {
    constexpr double h = 0.1;
    for (const int steps : {700, 795}) {
        const double node = 1e-7 * 0.5 * pi / h * std::pow(1.02, steps);
        const auto scale = [&](double crossing) {
            return SampledPlant(of_orders({{1.0, 1.5 - crossing * h / pi}}), h, "plant").scale();
        };
        EXPECT_NEAR(scale(1.002 * node) / node, 1.0, 1e-9) << steps;
        EXPECT_NEAR(scale(0.998 * node) * 1.02 / node, 1.0, 1e-9) << steps;
    }
}

// A phase that goes on below -180 degrees is followed: 1 / (s (T s + 1)^3) passes -135 degrees where 3 atan(w T) is 45.
TEST(TuneEdges, TheScaleIsOfAPhaseThatIsFollowed) {
    const drive::Model steep = of_orders({{0.001, 4.0}, {0.03, 3.0}, {0.3, 2.0}, {1.0, 1.0}});
    const double crossing = std::tan(pi / 12.0) / 0.1;
    const double scale = SampledPlant(steep, 1e-4, "plant").scale();
    EXPECT_LE(scale, crossing);
    EXPECT_GT(scale * 1.021, crossing);
    // Three integrations begin at -270 degrees; 45 below is where the dead time and half a sample make 45.
    const SampledPlant three(of_orders({{1.0, 3.0}}, 0.5), 0.25, "plant");
    EXPECT_LE(three.scale(), 0.25 * pi / 0.625);
    EXPECT_GT(three.scale() * 1.02, 0.25 * pi / 0.625);
    EXPECT_EQ(three.integrations(), 3.0);
}

// What decides the sign and the phase at low frequencies is what is left of both polynomials there.
TEST(TuneEdges, LowFrequenciesDecideTheSignAndTheIntegrations) {
    drive::Model model = of_orders({{1.0, 3.0}, {3.0, 2.0}, {3.0, 1.0}});
    model.numerator = {{-0.5, 1.0}, {1.0, 0.0}};  // at first it goes the other way
    EXPECT_EQ(SampledPlant(model, 0.1, "plant").sign(), 1.0);
    EXPECT_EQ(SampledPlant(model, 0.1, "plant").integrations(), 1.0);
    model.numerator = {{-0.5, 1.0}, {0.0, 0.0}};
    EXPECT_EQ(SampledPlant(model, 0.1, "plant").sign(), -1.0);
    EXPECT_EQ(SampledPlant(model, 0.1, "plant").integrations(), 0.0);
    model.denominator = {{1.0, 2.0}, {2.0, 1.0}, {1.0, 0.0}};
    EXPECT_EQ(SampledPlant(model, 0.1, "plant").integrations(), -1.0);
}

// No aliases up to a hundredth of a radian a sample, twenty on each side below 0.3 and two hundred from there on.
TEST(TuneEdges, AliasesAreCountedByTheAngleOfASample) {
    const SampledPlant plant(drive::make_fopdt(2.0, 0.7, 0.3), 1.0, "plant");
    const auto with = [&](double w, int aliases) {
        Complex sum = plant.continuous({0.0, w}) / Complex(0.0, w);
        for (int k = 1; k <= aliases; ++k) {
            for (const double there : {w + 2.0 * pi * k, w - 2.0 * pi * k}) {
                sum += plant.continuous({0.0, there}) / Complex(0.0, there);
            }
        }
        return (1.0 - std::polar(1.0, -w)) * sum;
    };
    for (const auto& [w, aliases] : {std::pair(0.00995, 0), std::pair(0.01, 0), std::pair(0.01005, 20),
                                     std::pair(0.2985, 20), std::pair(0.3, 200), std::pair(0.3015, 200)}) {
        EXPECT_LT(std::abs(plant(w) - with(w, aliases)), 1e-13) << w;
    }
}

// The frequencies that a sweep asks of a controller.
class Asked {
public:
    Asked(const SampledPlant& plant, double kp, double from = INFINITY) {
        (void)tune::margins_of(plant, {[&](double w) {
                                           all_.insert(w);
                                           return Complex(kp);
                                       },
                                       0.0, from});
    }
    [[nodiscard]] double lowest() const { return *all_.begin(); }
    [[nodiscard]] double highest() const { return *all_.rbegin(); }
    [[nodiscard]] bool holds(double w) const {
        const auto next = all_.lower_bound(w * (1.0 - 1e-11));
        return next != all_.end() && *next < w * (1.0 + 1e-11);
    }

private:
    std::set<double> all_;
};

// Steps of a hundredth up to 1.06 times where |L| was last seen at 0.05 or above, in twentieths down from half the
// samples' frequency; from there on of a twentieth.
TEST(TuneEdges, ASweepIsDenseAsLongAsTheLoopCanMatter) {
    const SampledPlant plant(of_orders({{1.0, 1.0}}), 0.1, "plant");
    const double top = plant.nyquist();
    const double loud = top / std::pow(1.05, 40);
    const Asked asked(plant, 1.004 * 0.05 / std::abs(plant(loud)));
    EXPECT_DOUBLE_EQ(asked.lowest(), 1e-4 * plant.scale());
    EXPECT_EQ(asked.highest(), top);
    int coarse = 0;
    for (double w = asked.lowest(); w < top; w *= w < 1.06 * loud ? 1.01 : 1.05) {
        ASSERT_TRUE(asked.holds(w)) << w;
        coarse += w < 1.06 * loud ? 0 : 1;
    }
    EXPECT_GT(coarse, 30);
    // A dead time and the sample turn by no more than 0.05 rad.
    const SampledPlant late(of_orders({{1.0, 1.0}}, 0.4), 0.1, "plant");
    const Asked slowly(late, 1e3);
    for (double w = slowly.lowest(); w < top; w += std::min(0.01 * w, 0.05 / 0.5)) {
        ASSERT_TRUE(slowly.holds(w)) << w;
    }
}

// It begins at a ten thousandth of the plant's scale or where the controller says, and below by tens as long as |L| is
// not 20, down to 1e-9 of half the samples' frequency.
TEST(TuneEdges, ASweepBeginsWhereTheLoopIsLarge) {
    const SampledPlant integrates(of_orders({{1.0, 1.0}}), 0.1, "plant");
    const double top = integrates.nyquist();
    EXPECT_DOUBLE_EQ(Asked(integrates, 1.0, 0.0004).lowest(), 0.0004);
    const double large = 20.0 / std::abs(integrates(0.0004));
    EXPECT_DOUBLE_EQ(Asked(integrates, 1.005 * large, 0.0004).lowest(), 0.0004);
    EXPECT_DOUBLE_EQ(Asked(integrates, 0.995 * large, 0.0004).lowest(), 0.00004);
    const SampledPlant rests(drive::make_fopdt(1.0, 1.0, 0.0), 0.1, "plant");
    EXPECT_DOUBLE_EQ(Asked(rests, 0.5, 1.005e-8 * top).lowest(), 1.005e-10 * top);
    EXPECT_DOUBLE_EQ(Asked(rests, 0.5, 0.995e-8 * top).lowest(), 0.995e-9 * top);
}

// The search's grid: from a ten thousandth of the scale by 4 % and by 0.25 rad of the dead time's phase, half the
// samples' frequency the last. |S| is the largest there, and the phase where |L| is 1 that between two of them in ln
// |L|. Behind 40 rad of the dead time's phase every phase counts.
TEST(TuneEdges, TheSearchsGridHasItsFrequencies) {
    struct Case {
        drive::Model model;
        drive::Gains gains;
        double integrations;
    };
    const drive::Gains all{.kp = 10.0, .ki = 3.0, .kd = 0.01, .filter_s = 0.1};
    drive::Model swinging = of_orders({{1.0 / 64.0, 2.0}, {0.0175, 1.0}, {1.0, 0.0}}, 10.0);
    swinging.gain = 0.1;
    for (const auto& [model, gains, integrations] :
         {Case{of_orders({{1.0, 1.0}}), all, 2.0}, Case{of_orders({{1.0, 1.0}}, 2.0), all, 2.0},
          Case{swinging, {.kp = 1.0}, 0.0}}) {
        const SampledPlant plant(model, 0.1, "plant");
        const tune::Loop loop{&plant, gains};
        const double delay_s = model.delay_s;
        double sensitivity = 0.0;
        double margin = pi;
        double phase = -0.5 * pi * integrations;
        double before = 0.0;
        for (double w = 1e-4 * plant.scale(); w < 1.04 * plant.nyquist();) {
            const double at = std::min(w, plant.nyquist());
            const Complex now = loop(at);
            const double size = std::abs(now);
            const bool spins = at * delay_s > 40.0;
            w += spins || delay_s == 0.0 ? 0.04 * w : std::min(0.04 * w, 0.25 / delay_s);
            if (spins) {
                sensitivity = std::max(sensitivity, 1.0 / (1.0 - size));
                continue;
            }
            const double turn = std::remainder(std::arg(now) - phase, 2.0 * pi);
            if (before > 1.0 && size <= 1.0) {
                margin = std::min(margin, phase + std::log(before) / std::log(before / size) * turn + pi);
            }
            phase += turn;
            before = size;
            sensitivity = std::max(sensitivity, 1.0 / std::abs(1.0 + now));
        }
        const tune::Grid::Answer answer = tune::Grid(plant)(gains);
        EXPECT_NEAR(answer.sensitivity / sensitivity, 1.0, 1e-12) << delay_s;
        EXPECT_NEAR(answer.phase_rad, margin, 1e-12) << delay_s;
    }
}

}  // namespace
