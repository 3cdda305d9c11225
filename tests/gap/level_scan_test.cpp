// Effects that begin at a level of the input: where among the levels they are looked for, and that a fitted base which
// has taken part of one up lets go of it.
#include "gap/drive/level_scan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gap/drive/fit.hpp"
#include "gap/drive/simulate.hpp"
#include "gap/drive/start.hpp"
#include "tests/gap/made_records.hpp"

namespace {

using Values = std::vector<double>;

double staircase(double t) {
    constexpr double held[] = {0.4, 1.0, 2.4, 1.9, 2.2, 2.0, 0.4, 1.2, 2.3, 1.4};
    return held[static_cast<std::size_t>(t / 25.0) % std::size(held)];
}

gap::Scales scales_of(const gap::Record& record, const drive::Model& model, bool two_signs) {
    gap::Scales scales = gap::scales_of(model, {record}, {});
    scales.two_signs = two_signs;
    return scales;
}

struct Told {
    gap::Record record = gap_test::record_of(1000, staircase);
    drive::Model model = drive::make_fopdt(5.0, 4.0, 0.0);

    // The base that meets the reading has another gain, another time constant and another operating point.
    [[nodiscard]] Values start_of(const std::string& name, const Values& truth, bool two_signs = false) {
        const gap::Effect& effect = gap::effect_named(name);
        gap::Scenario with;
        with.model = model;
        effect.add_to(with, truth);
        const gap::Course course(record, 1);
        record.output = gap::simulate(with, course);
        for (double& reading : record.output) {
            reading -= 3.0;
        }
        gap::Scenario base;
        base.model = drive::make_fopdt(7.0, 5.0, 0.0);
        const gap::Scales scales = scales_of(record, base.model, two_signs);
        return effect.start({course, base, Values(record.size(), 0.0), scales});
    }
};

// Where it runs on until the input is 0, which here never is, only the levels before it has started tell.
TEST(LevelScan, AThresholdStartsBetweenTheLevelsThatItParts) {
    const Values levels = {0.0, 0.4, 1.0, 1.2, 1.4, 1.9, 2.0, 2.2, 2.3, 2.4};
    const auto between = [&](double threshold) {
        const auto above = std::upper_bound(levels.begin(), levels.end(), threshold);
        return 0.5 * (*above + *(above - 1));
    };
    for (const double threshold : {0.7, 1.1, 1.3, 1.95}) {
        const Values found = Told().start_of("start_up_threshold", {threshold, 1.0, 0.0});
        EXPECT_NEAR(found.at(0), between(threshold), 1e-9) << threshold;
        EXPECT_EQ(found.at(1), 1.0) << threshold;
    }
    const Values running_on = Told().start_of("start_up_threshold", {0.7, 0.0, 0.0});
    EXPECT_NEAR(running_on.at(0), 0.7, 1e-9);
    EXPECT_EQ(running_on.at(1), 0.0);
}

TEST(LevelScan, ADeadZoneStartsBetweenTheLevelsThatItParts) {
    for (const bool two_signs : {false, true}) {
        Told told;
        const Values found = told.start_of("input_dead_zone", {0.606, -1.0}, two_signs);
        EXPECT_NEAR(found.at(0), 0.7, 1e-9);
        EXPECT_EQ(found.at(1), two_signs ? found.at(0) : -1.0);
    }
}

// Of more levels as many places as are worth their simulations; of one level there is the one half-way to 0.
TEST(LevelScan, TriesAtMost24Places) {
    gap::Record ramp = gap_test::record_of(1000, [](double t) { return 0.01 * t; });
    const gap::Course course(ramp, 1);
    gap::Scenario base;
    base.model = drive::make_fopdt(5.0, 4.0, 0.0);
    Values places;
    const auto add = [&](gap::Scenario&, double level) { places.push_back(level); };
    (void)gap::scan_levels({course, base, {}, {}}, add);
    EXPECT_EQ(places.size(), 24U);
    EXPECT_LT(places.front(), 0.1);
    EXPECT_GT(places.back(), 2.4);
    // A place once, however long its levels are held.
    const gap::Record rests = gap_test::record_of(1000, [](double t) { return t < 60.0 ? 0.01 * t : 0.6; });
    places.clear();
    (void)gap::scan_levels({gap::Course(rests, 1), base, {}, {}}, add);
    EXPECT_TRUE(std::ranges::adjacent_find(places) == places.end());
    EXPECT_LT(places.size(), 24U);
    const gap::Record held = gap_test::record_of(100, [](double) { return -2.0; });
    places.clear();
    (void)gap::scan_levels({gap::Course(held, 1), base, {}, {}}, add);
    EXPECT_THAT(places, testing::ElementsAre(1.0));
    const gap::Record still = gap_test::record_of(100, [](double) { return 0.0; });
    EXPECT_EQ(gap::scan_levels({gap::Course(still, 1), base, {}, {}}, add).level, 0.0);
}

// As long as no level lies within it a dead zone is an operating point: beside a base that was fitted without it, a
// width that grows by itself only makes things worse.
TEST(LevelScan, AFittedBaseFollowsADeadZone) {
    gap::Record record = gap_test::record_of(1000, staircase);
    gap::Scenario truth;
    truth.model = drive::make_fopdt(5.0, 4.0, 0.0);
    const gap::Effect& dead_zone = gap::effect_named("input_dead_zone");
    dead_zone.add_to(truth, Values{0.606, -1.0});
    record.output = gap::simulate(truth, gap::Course(record, 1));
    const std::vector<gap::Record> records = {record};
    gap::Study study{{gap::form_of(drive::make_fopdt(5.0, 4.0, 0.0)), true}, {}, {}, {}, 0.01, 0.001, 0};
    study.counts = gap::all_count(records);
    study.courses.emplace_back(records[0], 1);
    study.scales = gap::scales_of(gap::model_of(study.base.form), records, {});
    const gap::Candidate none = gap::fit(study, {}, {}, nullptr);
    const gap::Candidate found = gap::fit(study, {&dead_zone}, none, nullptr);
    EXPECT_LT(found.cost, 1e-4 * none.cost);
    EXPECT_NEAR(found.lasting[0][0].value, 0.606, 0.01);
}

}  // namespace
