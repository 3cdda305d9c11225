// What a cascade's rounding costs, to first order, section by section, counted anew from what section_rounding.hpp and
// cascade_bound.hpp state: neither too small nor larger than what was derived.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "bench/sweep/host_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/filter/section_rounding.hpp"
#include "glsum/registry.hpp"

namespace {

using namespace glsum;

constexpr double u = 0x1p-24;
constexpr double peak = 0.75;
using OfFloats = Sum<Cascade, DirectForm2Transposed, F32>;
using OfIntegers = Sum<Cascade, DirectForm1, Q31>;

template <class K>
double bound_of(const Design& design) {
    bench::HostLine<K> line(design);
    EXPECT_EQ(line.status(), Status::ok) << K::name();
    return error_bound<K>(design, line.state(), peak, longest_record);
}

// Decays that forget in some samples, so that what rounding does to a pole moves it by next to nothing.
const std::vector<Mode> one = {{0.3, -0.04}};
const std::vector<Mode> two = {{0.1, -0.02}, {0.5, -0.05}};
const std::vector<Mode> three = {{0.06, -0.004}, {0.3, -0.03}, {0.6, -0.08}};

// An error passes a section by its l1 norm; what a section adds in each step passes its poles, 1/(d d') of it.
template <class Format, class Rounding>
double expected(const Design& design, double entering, const Rounding& rounding) {
    double error = entering;
    double reach = peak;
    double gain = 1.0;
    (void)for_each_section<Format>(design, [&](const HeldSection& held, const SectionPlace& place) {
        const Section& s = place.exact;
        const double before = reach;
        gain *= s.gain;
        reach = peak * (1.0 + std::fabs(gain - 1.0));
        const double of_coefficients =
            (std::fabs(held.b1 / place.down - s.b1) + std::fabs(held.b2 / place.down - s.b2)) * before +
            (std::fabs(held.a1 - s.a1) + std::fabs(held.a2 - s.a2)) * reach;
        error = (1.0 + std::fabs(s.gain - 1.0)) * error + of_coefficients / (s.slow * s.fast) +
                rounding(s, place, before, reach);
        return true;
    });
    return error;
}

// Of the output y: u Y; of what is kept of it, s1: u (2 |b1| X + 2 |a1| Y + 2 (X + Y) + s2); of s2, 2 u of |b2| X +
// |a2| Y.
TEST(CascadeBound, OfSectionsInSinglePrecision) {
    for (const auto& modes : {one, two, three}) {
        const Design design{0.5, 1 + 2 * modes.size(), modes};
        const double wanted =
            expected<F32>(design, u * peak, [](const Section& s, const SectionPlace&, double before, double reach) {
                const double of_second = std::fabs(s.b2) * before + std::fabs(s.a2) * reach;
                const double of_first =
                    2.0 * std::fabs(s.b1) * before + 2.0 * std::fabs(s.a1) * reach + 2.0 * (before + reach) + of_second;
                return u * (reach + of_first + 2.0 * of_second) / (s.slow * s.fast);
            });
        EXPECT_NEAR(bound_of<OfFloats>(design) / wanted, 1.0, 2e-4) << modes.size();
    }
}

// Half a unit of each section's output, whose rounding is high-passed: at most 2/d of it, d of the faster pole. A
// section's unit is that of its scale.
TEST(CascadeBound, OfSectionsInFixedPoint) {
    for (const auto& modes : {one, two, three}) {
        const Design design{0.5, 1 + 2 * modes.size(), modes};
        const double wanted =
            expected<Q31>(design, 0x1p-32, [](const Section& s, const SectionPlace& place, double, double) {
                return 2.0 / s.fast * std::ldexp(0.5, place.scale_bits - 31);
            });
        EXPECT_NEAR(bound_of<OfIntegers>(design) / wanted, 1.0, 2e-4) << modes.size();
    }
}

// Behind near taps the cascade is a term as a window's are: what it has lost passes the last tap's coefficient. In
// fixed point half a unit of each coefficient, sample and output beside it; the cascade's output reaches 1 at most.
TEST(CascadeBound, OfNearTapsInFixedPoint) {
    for (const std::size_t near_taps : {2U, 3U, 6U}) {
        std::vector<double> a = {1.0};
        for (std::size_t j = 1; j < near_taps; ++j) {
            a.push_back(a.back() * (1.0 - 1.5 / static_cast<double>(j)));
        }
        std::vector<Mode> of_lead_one = two;
        for (Mode& mode : of_lead_one) {
            mode.weight /= a.back();
        }
        const Design design{0.5, near_taps + 4, two};
        bench::HostLine<OfIntegers> line(design);
        ASSERT_EQ(line.status(), Status::ok);
        const double coefficient = std::ldexp(0.5, line.state().scale.table_exponent - 31);
        double samples = 0.0;
        for (std::size_t j = 0; j + 1 < near_taps; ++j) {
            samples += std::fabs(a[j]) * 0x1p-32;
        }
        const double wanted = std::fabs(a.back()) * bound_of<OfIntegers>({0.5, 5, of_lead_one}) + samples +
                              (peak * static_cast<double>(near_taps - 2) + 1.0) * coefficient +
                              std::ldexp(0.5, line.state().scale.output_exponent - 31);
        EXPECT_NEAR(bound_of<OfIntegers>(design) / wanted, 1.0, 1e-6) << near_taps;
    }
}

// Beside what the format holds of them, zeros and coefficients err by 2^-46 of themselves, as doubles made them; and
// half a unit enters.
TEST(CascadeBound, CountsWhatADoubleErrsBy) {
    const Section section{0.25, -0.125, -0.5, 0.0625, 1.25, 0.25, 0.5};
    const HeldSection held{1.0, section.b1, section.b2, section.a1, section.a2};
    CascadeError<Q31> walk(peak, section.fast);
    EXPECT_EQ(walk.error(), 0x1p-32);
    walk.pass(section, held, 1.0, 0);
    const double kept = 0.25 * 0.5;
    const double reach = peak * 1.25;
    const double wrong =
        kept * (1.25 * 0x1p-32 + 0x1p-31 / 0.5) + 0x1p-46 * 0.375 * (peak + 0x1p-32) + 0x1p-46 * 0.5625 * reach;
    EXPECT_EQ(walk.reach(), reach);
    EXPECT_NEAR(walk.error() / (wrong / (kept - 0x1p-46 * 0.5625)), 1.0, 1e-9);
}

// Where a pole is negative, d > 1, the response swings: by d/(2 - d) times the gain's distance from 1.
TEST(CascadeBound, OfAPoleThatSwings) {
    const auto reach = [](double fastest, double gain) {
        CascadeError<F32> walk(peak, fastest);
        walk.pass({0.0, 0.0, 0.0, 0.0, gain, 0.5, fastest}, {1.0, 0.0, 0.0, 0.0, 0.0}, 1.0, 0);
        return walk.reach() / peak;
    };
    EXPECT_DOUBLE_EQ(reach(1.5, 1.5), 1.0 + 3.0 * 0.5);
    EXPECT_DOUBLE_EQ(reach(1.5, 0.5), 1.0 + 3.0 * 0.5);
    EXPECT_DOUBLE_EQ(reach(1.2, 1.5), 1.0 + 1.5 * 0.5);
    EXPECT_DOUBLE_EQ(reach(1.005, 1.5), 1.0 + 1.005 / 0.995 * 0.5);
    EXPECT_DOUBLE_EQ(reach(1.0, 1.5), 1.5);
    EXPECT_DOUBLE_EQ(reach(0.5, 1.5), 1.5);
}

// Of silence only what vanishes is left, the smallest denormal number at most. The input has one, whose l1 norm passes,
// and each near tap. Each of a section's four products has one, which its poles add up.
TEST(CascadeBound, OfSilenceAreDenormals) {
    constexpr double least = std::numeric_limits<float>::denorm_min();
    CascadeError<F32> walk(0.0, 0.5);
    EXPECT_EQ(walk.error(), least);
    walk.pass({0.0, 0.0, 0.0, 0.0, 1.25, 0.25, 0.5}, {1.0, 0.0, 0.0, 0.0, 0.0}, 1.0, 0);
    EXPECT_EQ(walk.reach(), 0.0);
    EXPECT_NEAR(walk.error() / least, 1.25 + 4.0 / (0.25 * 0.5), 1e-3);
    constexpr double lead = -0.0625;  // a_3 of order 1/2
    std::vector<Mode> of_lead_one = two;
    for (Mode& mode : of_lead_one) {
        mode.weight /= lead;
    }
    const auto silent = [](const Design& design) {
        bench::HostLine<OfFloats> line(design);
        EXPECT_EQ(line.status(), Status::ok);
        return error_bound<OfFloats>(design, line.state(), 0.0) / least;
    };
    EXPECT_NEAR(silent({0.5, 4 + 4, two}), std::fabs(lead) * silent({0.5, 1 + 4, of_lead_one}) + 4.0, 1e-3);
}

}  // namespace
