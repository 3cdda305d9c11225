// What could have been known of logs whose effect is known.
#include "gap/drive/oracle.hpp"

#include <gtest/gtest.h>

#include "stand_case.hpp"

namespace {

using gap::foresee;
using gap::Foresight;
using gap_test::question_of;
using gap_test::Run;

const Run bits{.experiment = "prbs", .low_duty = 0.02, .seed = 72};

TEST(Oracle, LeadsWhereTheEffectShowsAtSeveralLevels) {
    const Foresight found = foresee(
        question_of({{"input_dead_zone.width", 0.015}}, {.seed = 71}, {.experiment = "ramp", .duty = 0.12, .seed = 72}),
        {"input_dead_zone"});
    EXPECT_GT(found.lead, 10.0);
    EXPECT_NE(found.nearest, "input_dead_zone");
    EXPECT_LT(found.gap_after, 0.1 * found.gap_base);
    EXPECT_EQ(found.by_plain_bic, "input_dead_zone");
    EXPECT_EQ(found.by_whitened_bic, "input_dead_zone");
}

TEST(Oracle, HasNoLeadOverALagThatCommutes) {
    const Foresight found = foresee(question_of({{"sensor_lag.tau_s", 0.1}}, {.seed = 73}, bits), {"sensor_lag"});
    EXPECT_LT(found.lead, 10.0);
    EXPECT_EQ(found.nearest, "actuator_lag");
}

TEST(Oracle, FitsBothOfAPair) {
    const Foresight found =
        foresee(question_of({{"backlash.gap", 0.05}, {"sensor_drift.per_s", 0.004}}, {.seed = 74}, bits),
                {"sensor_drift", "backlash"});
    EXPECT_GT(found.lead, 10.0);
    EXPECT_LT(found.gap_after, 0.02);
}

// White-noise criteria take colour for an effect, whitened ones less often.
TEST(Oracle, ShowsWhatAPlainCriterionAccuses) {
    int plain = 0;
    int whitened = 0;
    for (const std::uint64_t seed : {75U, 85U, 95U}) {
        const Foresight found =
            foresee(question_of({}, {.seed = seed, .colour = 0.9},
                                {.experiment = "prbs", .low_duty = 0.02, .seed = seed + 1, .colour = 0.9}),
                    {});
        plain += found.by_plain_bic != "none" ? 1 : 0;
        whitened += found.by_whitened_bic != "none" ? 1 : 0;
        EXPECT_EQ(found.lead, 0.0);
        EXPECT_EQ(found.gap_after, found.gap_base);
    }
    EXPECT_EQ(plain, 3);
    EXPECT_LT(whitened, plain);
}

}  // namespace
