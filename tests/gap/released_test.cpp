// A free motion counts from where it is let go.
#include "gap/drive/released.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

// 200 readings at 10 Hz about `rest`: led out for so many samples to 1, then let go.
gap::Record let_go_after(std::size_t led, double rest = 0.0, double side = 1.0) {
    gap::Record record;
    record.name = "let go";
    record.usual_interval_s = 0.1;
    for (std::size_t i = 0; i < 200; ++i) {
        record.time_s.push_back(0.1 * static_cast<double>(i));
        record.input.push_back(0.0);
        const double t = 0.1 * (static_cast<double>(i) - static_cast<double>(led));
        const double z = i < led ? 0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(led)
                                 : std::exp(-0.3 * t) * std::cos(3.0 * t);
        record.output.push_back(rest + side * z);
    }
    return record;
}

TEST(Released, IsAtTheFarthestReadingOfTheFirstSide) {
    EXPECT_EQ(gap::samples_held(let_go_after(0)), 0U);
    EXPECT_EQ(gap::samples_held(let_go_after(7)), 7U);
    EXPECT_EQ(gap::samples_held(let_go_after(7, 5.0)), 7U);
    EXPECT_EQ(gap::samples_held(let_go_after(7, -2.0, -1.0)), 7U);
    // One that passes by where it rests before it turns is on its way already.
    gap::Record kicked = let_go_after(0);
    for (std::size_t i = 0; i < kicked.size(); ++i) {
        kicked.output[i] = std::exp(-0.3 * kicked.time_s[i]) * std::sin(3.0 * kicked.time_s[i] - 0.1);
    }
    EXPECT_EQ(gap::samples_held(kicked), 0U);
}

TEST(Released, IsNotTakenLateOrFromWhatNeverPassesItsRest) {
    EXPECT_EQ(gap::samples_held(let_go_after(49)), 49U);
    EXPECT_EQ(gap::samples_held(let_go_after(50)), 0U);
    gap::Record creeps = let_go_after(0);
    for (std::size_t i = 0; i < creeps.size(); ++i) {
        creeps.output[i] = i < 5 ? 0.2 * static_cast<double>(i) : std::max(0.2, 1.0 - 0.01 * static_cast<double>(i));
    }
    creeps.output.back() = 0.2;
    EXPECT_EQ(gap::samples_held(creeps), 0U);
}

TEST(Released, LeavesOutTheSamplesBeforeIt) {
    const auto counts =
        gap::from_release({std::vector<char>(200, 1), std::vector<char>(200, 1)}, {let_go_after(7), let_go_after(0)});
    for (std::size_t i = 0; i < 200; ++i) {
        EXPECT_EQ(counts[0][i], i < 7 ? 0 : 1) << i;
        EXPECT_EQ(counts[1][i], 1) << i;
    }
}

TEST(Released, IsSaidWhereItIsNotTheFirstSample) {
    std::vector<std::string> notes;
    gap::say_releases({let_go_after(7), let_go_after(0)}, notes);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0], "let go: counts from 0.7 s on, its first turn: before that it may be held");
}

}  // namespace
