// A kernel's table read back is the filter that it was made of, as far as its format holds that.
#include "glsum/design/held.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "bench/sweep/host_line.hpp"
#include "glsum/registry.hpp"

namespace {

using namespace glsum;

// a_0 ... a_(K-1) of an order.
std::vector<double> near_taps_of(double order, std::size_t near_taps) {
    std::vector<double> taps = {1.0};
    for (std::size_t j = 1; j < near_taps; ++j) {
        taps.push_back(taps.back() * (1.0 - (order + 1.0) / static_cast<double>(j)));
    }
    return taps;
}

void expect_filter(const design::Filter& found, const std::vector<double>& taps, const std::vector<Mode>& modes,
                   double within) {
    ASSERT_EQ(found.taps.size(), taps.size());
    ASSERT_EQ(found.modes.size(), modes.size());
    for (std::size_t j = 0; j < taps.size(); ++j) {
        EXPECT_NEAR(found.taps[j], taps[j], within) << j;
    }
    for (std::size_t m = 0; m < modes.size(); ++m) {
        EXPECT_NEAR(found.modes[m].decay, modes[m].decay, within) << m;
        EXPECT_NEAR(found.modes[m].weight, modes[m].weight, within) << m;
    }
}

template <class Technique, class Format>
void expect_modes_back(const Design& asked, const std::vector<double>& taps, const std::vector<Mode>& modes) {
    bench::HostLine<Sum<Modes, Technique, Format>> line(asked);
    ASSERT_EQ(line.status(), Status::ok);
    expect_filter(design::held<Technique, Format>(line.state()), taps, modes, 0.0);
}

// Powers of two, and the first weights of these orders, every format holds to the bit: of 1.5 at half scale.
TEST(Held, OfModesIsTheDesign) {
    for (const std::vector<Mode>& modes :
         {std::vector<Mode>{}, std::vector<Mode>{{0.25, -0.0625}},
          std::vector<Mode>{{0.03125, -0.0078125}, {0.125, -0.015625}, {0.5, -0.03125}}}) {
        for (const double order : {0.5, 1.5}) {
            for (const std::size_t near_taps : {1U, 3U}) {
                const Design design{order, near_taps + 2 * modes.size(), modes};
                const std::vector<double> taps = near_taps_of(order, near_taps);
                expect_modes_back<Plain, F32>(design, taps, modes);
                expect_modes_back<Compensated, F32>(design, taps, modes);
                expect_modes_back<Plain, Q31>(design, taps, modes);
            }
        }
    }
}

// A running sum is its slowest mode; where there is none, no mode of nothing stands for it.
TEST(Held, OfAnIntegratorHasItsRunningSum) {
    for (const std::vector<Mode>& modes :
         {std::vector<Mode>{}, std::vector<Mode>{{0.0, 0.25}}, std::vector<Mode>{{0.0, 0.25}, {0.125, 0.5}}}) {
        bench::HostLine<Sum<Integrator, Plain, F32>> line({-0.5, 3 + 2 * modes.size(), modes});
        ASSERT_EQ(line.status(), Status::ok);
        expect_filter(design::held_with_integrator<Plain, F32>(line.state()), near_taps_of(-0.5, 3), modes, 0.0);
    }
}

// A cascade holds zeros and poles: its partial fractions are the design's modes again, but for what rounding moved.
template <class Technique, class Format>
void expect_cascade_back(double order, std::size_t near_taps, const std::vector<Mode>& modes, double within) {
    bench::HostLine<Sum<Cascade, Technique, Format>> line({order, near_taps + 2 * modes.size(), modes});
    ASSERT_EQ(line.status(), Status::ok);
    expect_filter(design::held_in_parallel<Technique, Format>(line.state()), near_taps_of(order, near_taps), modes,
                  within);
}

TEST(Held, OfACascadeIsTheDesignInParallel) {
    for (const std::size_t near_taps : {1U, 2U, 4U}) {
        // An integral's answer to a constant is several times its input, which q31 scales down.
        for (const std::vector<Mode>& modes :
             {std::vector<Mode>{{0.25, 0.5}}, std::vector<Mode>{{0.125, 0.25}, {0.5, 0.25}},
              std::vector<Mode>{{0.0625, 0.125}, {0.25, 0.25}, {0.625, 0.125}}}) {
            expect_cascade_back<DirectForm2Transposed, F32>(-0.5, near_taps, modes, 1e-5);
            expect_cascade_back<DirectForm1, Q31>(-0.5, near_taps, modes, 1e-6);
        }
        for (const std::vector<Mode>& modes :
             {std::vector<Mode>{{0.25, -0.0625}}, std::vector<Mode>{{0.125, -0.03125}, {0.5, -0.0625}},
              std::vector<Mode>{{0.0625, -0.0078125}, {0.25, -0.03125}, {0.625, -0.0625}}}) {
            expect_cascade_back<DirectForm2Transposed, F32>(0.5, near_taps, modes, 1e-5);
            expect_cascade_back<DirectForm1, Q31>(0.5, near_taps, modes, 1e-6);
        }
    }
}

}  // namespace
