// What the stand's driver makes of commands: levels behind a delay, a motor that starts, a slope.
#include "drive/stand/stand.hpp"

#include <gtest/gtest.h>

#include "drive/stand/experiment.hpp"
#include "drive/stand/motion.hpp"
#include "tests/drive/stand_rig.hpp"

namespace {

using test::bare;
// Each piece by hand: where it begins, from which level, how steeply.
void expect_pieces(const stand::Stand& built, const std::vector<stand::Command>& commands,
                   const std::vector<stand::Piece>& expected) {
    const std::vector<stand::Piece> found = stand::drive_motor(built, commands);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_DOUBLE_EQ(found[i].time_s, expected[i].time_s) << i;
        EXPECT_NEAR(found[i].level, expected[i].level, 1e-15) << i;
        EXPECT_NEAR(found[i].slope_per_s, expected[i].slope_per_s, 1e-15) << i;
    }
}

TEST(Driver, HoldsLevelsBehindItsDelay) {
    stand::Stand built = bare();
    built.delay_s = 0.25;
    built.extra_delay_s = 0.5;
    built.start_up_s = 0.0;
    built.threshold = 0.125;
    built.dead_zone = 0.0625;
    built.input_limit = 0.5;
    // At the threshold it turns, below it does not; what is commanded again changes nothing.
    expect_pieces(built, {{0.0, 0.125}, {1.0, 0.12}, {2.0, 0.375}, {3.0, 0.375}, {4.0, 1.0}},
                  {{0.0, 0.0, 0.0}, {0.75, 0.0625, 0.0}, {1.75, 0.0, 0.0}, {2.75, 0.3125, 0.0}, {4.75, 0.5, 0.0}});
    built.delay_s = built.extra_delay_s = 0.0;
    built.threshold = 0.0;
    expect_pieces(built, {{0.0, 0.25}, {1.0, -0.5}, {2.0, 0.03125}}, {{0.0, 0.1875, 0.0}, {1.0, 0.0, 0.0}});
}

TEST(Driver, StartsAMotorThatStandsEachTimeAnew) {
    stand::Stand built = bare();
    built.delay_s = 0.0;
    built.start_up_s = 0.5;
    built.threshold = 0.125;
    // Other duties while it starts count from its turning on; off before it turns, it never does.
    expect_pieces(built, {{1.0, 0.25}, {1.25, 0.5}, {2.0, 0.0}, {3.0, 0.25}, {3.25, 0.0}, {4.0, 0.75}},
                  {{0.0, 0.0, 0.0}, {1.5, 0.5, 0.0}, {2.0, 0.0, 0.0}, {4.5, 0.75, 0.0}});
    // It turns just as the next command comes: with that one.
    expect_pieces(built, {{1.0, 0.25}, {1.5, 0.5}}, {{0.0, 0.0, 0.0}, {1.5, 0.5, 0.0}});
    // Off before or just as it would turn, and never on again.
    expect_pieces(built, {{1.0, 0.25}, {1.25, 0.0}}, {{0.0, 0.0, 0.0}});
    expect_pieces(built, {{1.0, 0.25}, {1.5, 0.0}}, {{0.0, 0.0, 0.0}});
    // No duty is off where there is no threshold, too.
    built.threshold = 0.0;
    expect_pieces(built, {{0.0, 0.25}, {1.0, 0.0}, {2.0, 0.25}},
                  {{0.0, 0.0, 0.0}, {0.5, 0.25, 0.0}, {1.0, 0.0, 0.0}, {2.5, 0.25, 0.0}});
}

TEST(Driver, GoesFromLevelToLevelByItsSlope) {
    stand::Stand built = bare();
    built.delay_s = 0.0;
    built.start_up_s = 0.0;
    built.threshold = 0.0;
    built.rate_per_s = 0.5;
    // Up to 0.5 in a second; down from there; cut short by the next; arrived just as it comes.
    expect_pieces(built, {{1.0, 0.5}, {3.0, 0.25}, {4.0, 1.0}, {5.0, 0.5}, {5.5, 0.25}},
                  {{0.0, 0.0, 0.0},
                   {1.0, 0.0, 0.5},
                   {2.0, 0.5, 0.0},
                   {3.0, 0.5, -0.5},
                   {3.5, 0.25, 0.0},
                   {4.0, 0.25, 0.5},
                   {5.0, 0.75, -0.5},
                   {5.5, 0.5, -0.5},
                   {6.0, 0.25, 0.0}});
}

}  // namespace
