// Sizes of a stand's file: their ranges, and what is said of a wrong one.
#include "drive/stand/stand.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "drive/stand/experiment.hpp"
#include "tests/drive/stand_rig.hpp"

namespace {

using test::message_of;
using testing::HasSubstr;
// What each size is where its effect is absent, and the least and the largest that it may be: such are taken, what lies
// beyond is refused. Files of stands hold such values.
TEST(Stand, SizesAreTakenToTheirEndsAndNotBeyond) {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    struct Range {
        const char* name;
        double absent, least, most;
    };
    const Range ranges[] = {
        {"inertia_kg_m2", 0.03, 1e-6, 1e3},
        {"damping_n_m_s", 0.11, 0.0, 1e3},
        {"gravity_n_m", 0.18, 0.0, 1e3},
        {"full_thrust_n", 7.0, 1e-6, 1e4},
        {"arm_m", 0.25, 1e-3, 10.0},
        {"delay_s", 0.02, 0.0, 10.0},
        {"interval_s", 0.01, 1e-4, 10.0},
        {"spread_s", 0.001, 0.0, 5.0},
        {"gain_error.gain", 1.0, 1e-3, 1e3},
        {"time_scale_error.scale", 1.0, 1e-2, 1e2},
        {"dead_time_error.extra_s", 0.0, 0.0, 10.0},
        {"start_up_time.duration_s", 0.0, 0.0, 10.0},
        {"start_up_threshold.threshold", 0.0, 0.0, 1.0},
        {"input_dead_zone.width", 0.0, 0.0, 1.0},
        {"input_saturation.limit", unlimited, 1e-6, unlimited},
        {"rate_limit.per_s", unlimited, 1e-6, unlimited},
        {"actuator_lag.tau_s", 0.0, 0.0, 100.0},
        {"input_curve.curvature", 0.0, -1.0, 1.0},
        {"input_curve.reference", 1.0, 1e-6, 1e6},
        {"supply_sag.per_unit_s", 0.0, 0.0, 10.0},
        {"supply_sag.resistance", 0.0, 0.0, 10.0},
        {"gain_drift.per_s", 0.0, -10.0, 10.0},
        {"coulomb_friction.force", 0.0, 0.0, 10.0},
        {"coulomb_friction.stiction", 1.0, 1.0, 100.0},
        {"direction_dependent_friction.force_up", 0.0, 0.0, 10.0},
        {"direction_dependent_friction.force_down", 0.0, 0.0, 10.0},
        {"quadratic_drag.coefficient", 0.0, 0.0, 100.0},
        {"gravity_nonlinearity.angle_per_unit", 0.0, 0.0, 100.0},
        {"end_stop.limit", unlimited, -unlimited, unlimited},
        {"end_stop.lower", -unlimited, -unlimited, unlimited},
        {"end_stop.restitution", 0.0, 0.0, 1.0},
        {"load_disturbance.from_s", 0.0, 0.0, 1e6},
        {"load_disturbance.to_s", 0.0, 0.0, 1e6},
        {"load_disturbance.size", 0.0, -10.0, 10.0},
        {"backlash.gap", 0.0, 0.0, 10.0},
        {"output_curve.curvature", 0.0, -1.0, 1.0},
        {"output_curve.reference", 1.0, 1e-6, 1e6},
        {"direction_asymmetry.tau_up_s", 0.0, 0.0, 100.0},
        {"direction_asymmetry.tau_down_s", 0.0, 0.0, 100.0},
        {"structural_resonance.hz", 12.0, 1e-2, 1e3},
        {"structural_resonance.damping", 0.03, 0.0, 1.0},
        {"structural_resonance.share", 0.0, -10.0, 10.0},
        {"sensor_lag.tau_s", 0.0, 0.0, 100.0},
        {"sensor_offset.offset", 0.0, -100.0, 100.0},
        {"sensor_drift.per_s", 0.0, -100.0, 100.0},
        {"noise.deviation", 0.0, 0.0, 100.0},
        {"sensor_saturation.limit", unlimited, 1e-6, unlimited},
        {"encoder_quantisation.step", 0.0, 0.0, 10.0},
        {"missed_counts.at_s", 0.0, 0.0, 1e6},
        {"missed_counts.sizes", 0.0, -1e6, 1e6},
        {"sampling_jitter.half_width_s", 0.0, 0.0, 5.0},
        {"dropped_samples.rate", 0.0, 0.0, 0.99},
    };
    ASSERT_EQ(stand::sizes().size(), std::size(ranges));
    for (std::size_t i = 0; i < std::size(ranges); ++i) {
        const stand::Size& size = stand::sizes()[i];
        const Range& range = ranges[i];
        EXPECT_EQ(size.neutral, range.absent) << range.name;
        stand::Stand built;
        stand::set_size(built, range.name, range.least);
        EXPECT_EQ(built.*size.value, range.least) << range.name;
        stand::set_size(built, range.name, range.most);
        EXPECT_EQ(built.*size.value, range.most) << range.name;
        for (const double beyond : {std::nextafter(range.least, -unlimited), std::nextafter(range.most, unlimited)}) {
            if (beyond < range.least || beyond > range.most) {
                EXPECT_THAT(message_of([&] { stand::set_size(built, range.name, beyond); }), HasSubstr(range.name));
            }
        }
        EXPECT_THAT(message_of([&] { stand::set_size(built, range.name, std::nan("")); }), HasSubstr(range.name));
        EXPECT_EQ(built.*size.value, range.most) << range.name;
    }
    // Those that shape an effect and do not make one.
    std::set<std::string> shaping;
    for (const stand::Size& size : stand::sizes()) {
        if (!size.decides) {
            shaping.insert(std::string(size.effect) + '.' + size.name);
        }
    }
    EXPECT_EQ(shaping,
              (std::set<std::string>{"input_curve.reference", "coulomb_friction.stiction", "end_stop.restitution",
                                     "load_disturbance.from_s", "load_disturbance.to_s", "output_curve.reference",
                                     "structural_resonance.hz", "structural_resonance.damping", "missed_counts.at_s"}));
}

TEST(Stand, SaysWhatIsWrongWithAFileAndWhere) {
    const auto said = [](const std::string& text) {
        return message_of([&] { (void)stand::parse_stand(text, "my.toml"); });
    };
    EXPECT_THAT(said("[backlash]\ngap = -1\n"), HasSubstr("my.toml:2: backlash.gap: expected 0 to 10, found -1"));
    EXPECT_THAT(said("[backlash]\nwidth = 1\n"), HasSubstr("my.toml:2: backlash: expected gap, found width"));
    EXPECT_THAT(said("[bakclash]\ngap = 1\n"), HasSubstr("my.toml:1: expected parts or one of the effects gain_error"));
    EXPECT_THAT(said("[backlash]\ngap = 'wide'\n"), HasSubstr("my.toml:2: backlash.gap: expected a number"));
    EXPECT_THAT(said("[backlash\n"), HasSubstr("my.toml:1: expected TOML"));
    EXPECT_THAT(said("gap = 1\n"), HasSubstr("my.toml:1: expected tables"));
    EXPECT_THAT(said("[sensor_lag]\ntau_s = nan\n"),
                HasSubstr("my.toml:2: sensor_lag.tau_s: expected 0 to 100, found nan"));
    EXPECT_THAT(said("[sensor_lag]\ntau_s = 1e-9\n"), HasSubstr("expected 0 or at least 0.0001 s"));
    EXPECT_THAT(said("[end_stop]\nlimit = -1\n"), HasSubstr("expected the lower stop below the upper"));
    EXPECT_THAT(said("[direction_asymmetry]\ntau_up_s = 1\n"), HasSubstr("expected both lags or none"));
    EXPECT_THAT(said("[parts]\nspread_s = 0.005\n"), HasSubstr("expected less than half of the interval"));
    EXPECT_THAT(said("[load_disturbance]\nsize = 1\n"), HasSubstr("expected from_s below to_s"));
    stand::Stand built;
    EXPECT_THAT(message_of([&] { stand::set_size(built, "actuator_lag.tau", 1.0); }), HasSubstr("actuator_lag.tau_s"));
    EXPECT_THAT(message_of([&] { (void)stand::run(built, {.name = "square"}, 1); }), HasSubstr("found square"));
    EXPECT_THAT(message_of([&] { (void)stand::run(built, {.duty = 1.2}, 1); }), HasSubstr("duties"));
    EXPECT_THAT(message_of([&] { (void)stand::run(built, {.until_s = 1e9}, 1); }), HasSubstr("10^6 samples"));
    EXPECT_THAT(message_of([&] { (void)stand::run(built, {.name = "release", .angle_rad = 2.0}, 1); }),
                HasSubstr("between the stops"));
}

}  // namespace
