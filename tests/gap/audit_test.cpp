// What records say of themselves, on records made for it.
#include "gap/drive/audit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "gap/drive/clipped.hpp"
#include "gap/drive/ends.hpp"
#include "tests/gap/audit_case.hpp"

namespace {

using audit_test::in_units;
using audit_test::noisy;
using audit_test::record_of;
using audit_test::unit;
using audit_test::Values;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Of white noise the median of |z - 2 z' + z''| is 0.6745 sqrt 6 deviations.
TEST(AuditNoise, IsThatOfSecondDifferences) {
    EXPECT_NEAR(gap::audit({record_of(noisy(20000, 4, 0.3))}).noise, 0.3, 0.01);
    // 1, 0, 0, 4, 0, ...: second differences by hand.
    const std::vector<double> made{0.0, 1.0, 0.5, 4.5, 3.0};
    // |0.5 - 2 + 0| = 1.5, |4.5 - 1 + 1| = 4.5, |3 - 9 + 0.5| = 5.5
    EXPECT_NEAR(gap::audit({record_of(made)}).noise, std::max(4.5 / (0.6745 * std::sqrt(6.0)), 0.29 * 0.5), 1e-9);
    // A straight line has none; what stays is held, and shows none.
    std::vector<double> ramp = noisy(300, 5, 0.3);
    std::vector<double> held = ramp;
    held.insert(held.end(), 600, 0.7);
    EXPECT_NEAR(gap::audit({record_of(held)}).noise, gap::audit({record_of(ramp)}).noise, 0.02);
    // A quantum makes 0.29 of itself, at least.
    std::vector<double> steps;
    for (int i = 0; i < 200; ++i) {
        steps.push_back(0.5 * (i / 20));
    }
    EXPECT_NEAR(gap::audit({record_of(steps)}).noise, 0.29 * 0.5, 1e-9);
}

// Noise is told by second differences, by those of the eighth order where they tell less than half as much. A swing of
// w radians a sample has differences of (2 sin(w / 2))^n of itself; white noise has sqrt((2n)! / n!^2).
TEST(AuditNoise, OfASwingIsThatOfDifferencesOfEighthOrder) {
    Values values = noisy(4000, 21);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = 0.01 * values[i] + std::sin(2.0 * std::numbers::pi * static_cast<double>(i) / 20.0);
    }
    // 0.313^8 over sqrt(12870), 1e-6 of the swing, is nothing beside it; 0.313^2 over sqrt(6) is 0.04.
    EXPECT_NEAR(gap::audit({record_of(values)}).noise, 0.01, 6e-4);
}

// Of a swing whose differences of eighth order tell a half of what those of second order do, 0.5 % less or more.
TEST(AuditNoise, IsThatOfEighthOrderBelowAHalf) {
    for (const double ratio : {0.4975, 0.5025}) {
        const double doubled_sine = std::pow(ratio * std::sqrt(12870.0 / 6.0), 1.0 / 6.0);
        const double w = 2.0 * std::asin(0.5 * doubled_sine);
        Values values(20000);
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = std::sin(w * static_cast<double>(i));
        }
        const double second = std::pow(doubled_sine, 2.0) / std::sqrt(6.0);
        const double told =
            (ratio < 0.5 ? ratio : 1.0) * second * std::sqrt(0.5) / 0.6745;  // sqrt(1/2): a sine's median
        EXPECT_NEAR(gap::audit({record_of(values)}).noise, told, 0.005 * told) << ratio;
    }
}

// Readings that stay where they are show no noise: the others alone are counted. Eight have no eighth differences.
TEST(AuditNoise, IsOfReadingsThatMove) {
    // |3 - 2 + 0.76|, |3 - 6 + 1|, twice none, |3.5 - 6 + 3|, |4.75 - 7 + 3|: 0.5, 0.75, 1.76, 2
    const gap::Audit found = gap::audit({record_of(in_units({0.76, 1.0, 3.0, 3.0, 3.0, 3.0, 3.5, 4.75}))});
    EXPECT_EQ(found.quantum, 0.0);
    EXPECT_NEAR(found.noise, 1.76 * unit / (0.6745 * std::sqrt(6.0)), 1e-9);
}

TEST(AuditHeld, AreReadingsThatRepeatWhileTheOutputMoves) {
    std::vector<double> values = noisy(1000, 6);
    EXPECT_EQ(gap::audit({record_of(values)}).held_share, 0.0);
    for (std::size_t i = 100; i < 900; i += 50) {
        values[i] = values[i + 1] = values[i - 1];  // two of fifty
    }
    const gap::Audit found = gap::audit({record_of(values)});
    EXPECT_NEAR(found.held_share, 32.0 / 1000.0, 1e-9);
    EXPECT_THAT(found.notes, Contains(HasSubstr("3.2 % of the readings repeat the one before while the output moves")));
    // At a stop the output does not move; neither does it where it rests.
    std::vector<double> stopped = noisy(1000, 7);
    for (double& value : stopped) {
        value = std::min(value, 0.5);
    }
    EXPECT_EQ(gap::audit({record_of(stopped)}).held_share, 0.0);
    // Less than one of 500 is chance.
    std::vector<double> once = noisy(1000, 8);
    once[500] = once[501] = once[499];
    EXPECT_EQ(gap::audit({record_of(once)}).held_share, 0.0);
    once[502] = once[499];
    EXPECT_NEAR(gap::audit({record_of(once)}).held_share, 0.003, 1e-9);
}

// Four readings before and behind differ each from the next, eight and more away from the record's ends.
TEST(AuditHeld, AreReadingsBesideOthersThatMove) {
    // How many are held where some, of 400, repeat the one before.
    const auto held = [](const std::vector<std::size_t>& repeats) {
        std::vector<double> values = noisy(400, 13);
        for (const std::size_t i : repeats) {
            values[i] = values[i - 1];
        }
        return std::lround(400.0 * gap::audit({record_of(values)}).held_share);
    };
    EXPECT_EQ(held({9}), 1);
    EXPECT_EQ(held({8}), 0);
    EXPECT_EQ(held({391}), 1);
    EXPECT_EQ(held({392}), 0);
    EXPECT_EQ(held({200, 201, 202}), 3);
    // Of two that repeat neither is held beside the other; farther away each is.
    EXPECT_EQ(held({200, 202}), 0);
    EXPECT_EQ(held({200, 203}), 0);
    EXPECT_EQ(held({200, 204}), 1);
    EXPECT_EQ(held({200, 205}), 2);
}

// A held reading is left by more than 2 1/2 steps, where readings have some.
TEST(AuditHeld, AreLeftByMoreThanASensorsSteps) {
    const auto held = [](double left_by) {
        Values numbers;
        for (int i = 0; i < 60; ++i) {
            numbers.push_back(4.0 * i);
        }
        numbers[31] = numbers[30];
        for (std::size_t i = 32; i < 60; ++i) {
            numbers[i] = numbers[31] + left_by + 4.0 * static_cast<double>(i - 32);
        }
        numbers[1] = 1.0;  // the step
        return gap::audit({record_of(numbers)}).held_share;
    };
    EXPECT_EQ(held(2.0), 0.0);
    EXPECT_NEAR(held(3.0), 1.0 / 60.0, 1e-12);
    // What stays for long is left once.
    Values long_ones = noisy(403, 13);
    for (std::size_t i = 200; i < 205; ++i) {
        long_ones[i] = long_ones[199];
    }
    const gap::Audit found = gap::audit({record_of(long_ones)});
    EXPECT_NEAR(found.held_share, 5.0 / 403.0, 1e-12);
    EXPECT_THAT(found.notes, Contains(HasSubstr("1.2 % of the readings repeat")));
}

// 0.2 % of the readings are chance, more are not.
TEST(AuditHeld, AreMoreThanTwoInAThousand) {
    const auto held = [](std::size_t count) {
        Values values = noisy(count, 17);
        values[300] = values[301] = values[299];
        return gap::audit({record_of(values)}).held_share;
    };
    EXPECT_EQ(held(1000), 0.0);
    EXPECT_NEAR(held(995), 2.0 / 995.0, 1e-12);
}

TEST(AuditLevels, AreTheInputsToAFiftieth) {
    gap::Record record = record_of(noisy(400, 9));
    const auto levels = [&](const std::vector<double>& of) {
        for (std::size_t i = 0; i < record.size(); ++i) {
            record.input[i] = of[i % of.size()];
        }
        return gap::audit({record}).levels;
    };
    EXPECT_EQ(levels({1.0}), 1U);
    EXPECT_EQ(levels({1.0, 0.981, -1.0, 0.0}), 3U);
    EXPECT_EQ(levels({1.0, 0.979, -1.0, 0.0}), 4U);
    std::vector<double> many;
    for (int i = -47; i <= 47; ++i) {
        many.push_back(0.021 * i);
    }
    many.push_back(1.0);
    EXPECT_EQ(levels(many), 95U);  // 1 is 0.013 from the last
    // Of all records together, once each.
    gap::Record other = record;
    std::fill(record.input.begin(), record.input.end(), 1.0);
    std::fill(other.input.begin(), other.input.end(), 0.5);
    EXPECT_EQ(gap::audit({record, other, record}).levels, 2U);
}

// A fiftieth of the largest input is none of its own, more is.
TEST(AuditLevels, AreMoreThanAFiftiethApart) {
    const auto levels = [](double other) {
        gap::Record record = record_of(noisy(64, 23));
        for (std::size_t i = 0; i < record.size(); ++i) {
            record.input[i] = i % 2 == 0 ? 50.0 : other;
        }
        return gap::audit({record}).levels;
    };
    EXPECT_EQ(levels(49.0), 1U);
    EXPECT_EQ(levels(48.995), 2U);
}

TEST(AuditNotes, SayWhatIsOdd) {
    gap::Record record = record_of(noisy(400, 10));
    EXPECT_THAT(gap::audit({record}).notes, IsEmpty());
    for (std::size_t i = 200; i < 400; ++i) {
        record.time_s[i] += 0.39;
    }
    EXPECT_THAT(gap::audit({record}).notes, IsEmpty());
    for (std::size_t i = 200; i < 400; ++i) {
        record.time_s[i] += 0.03;
    }
    EXPECT_THAT(gap::audit({record}).notes, Contains(HasSubstr("made: a gap of 0.52 s between stamps, usually 0.1 s")));
    // Ten readings in a row at the top are clipped, nine may be chance.
    std::vector<double> values = noisy(400, 11);
    const double top = *std::max_element(values.begin(), values.end()) + 0.1;
    std::fill_n(values.begin() + 40, 9, top);
    EXPECT_THAT(gap::audit({record_of(values)}).notes, IsEmpty());
    values[49] = top;
    EXPECT_THAT(gap::audit({record_of(values)}).notes, Contains(HasSubstr("made: 10 readings are held at ")));
    // Coarse steps are often the highest.
    values = noisy(400, 11);
    for (double& value : values) {
        value = 0.5 * std::round(std::clamp(value, -1.0, 1.0) / 0.5);
    }
    EXPECT_THAT(
        gap::audit({record_of(values)}).notes,
        testing::AllOf(Contains(HasSubstr("readings are multiples of 0.5")), Not(Contains(HasSubstr("clipped")))));
}

// A gap is longer than five usual intervals, between the first stamps as anywhere.
TEST(AuditNotes, SayWhereStampsAreFarApart) {
    const auto notes = [](std::size_t at, double by_s) {
        gap::Record record = record_of(noisy(64, 29), 0.125);
        for (std::size_t i = at; i < record.size(); ++i) {
            record.time_s[i] += by_s;
        }
        return gap::audit({record}).notes;
    };
    EXPECT_THAT(notes(1, 0.5), IsEmpty());
    EXPECT_THAT(notes(1, 0.502), Contains(HasSubstr("made: a gap of 0.627 s between stamps, usually 0.125 s")));
    EXPECT_THAT(notes(63, 0.502), Contains(HasSubstr("made: a gap of 0.627 s between stamps")));
}

// 400 noisy readings, of which some in a row are what a sensor ends at.
std::vector<double> clipped(std::size_t from, std::size_t count, double limit) {
    std::vector<double> values = noisy(400, 11);
    std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(from), count, limit);
    return values;
}

std::ptrdiff_t clipped_in(const std::vector<double>& output) {
    const std::vector<char> found = gap::clipped_readings(record_of(output));
    return std::count(found.begin(), found.end(), 1);
}

TEST(Clipped, AreTenEqualReadingsInARowAtAnExtreme) {
    EXPECT_EQ(clipped_in(clipped(100, 10, 9.0)), 10);
    EXPECT_EQ(clipped_in(clipped(100, 9, 9.0)), 0);
    EXPECT_EQ(clipped_in(clipped(390, 10, -9.0)), 0);  // at rest, perhaps
    std::vector<double> both = clipped(390, 10, -9.0);
    std::fill_n(both.begin() + 20, 12, 9.0);
    EXPECT_EQ(clipped_in(both), 22);
    EXPECT_EQ(clipped_in(clipped(100, 30, 0.5)), 0);  // held, in the middle
    std::vector<double> apart = clipped(100, 20, 9.0);
    apart[109] = 8.5;
    EXPECT_EQ(clipped_in(apart), 10);
    EXPECT_EQ(gap::clipped_readings(record_of(clipped(100, 10, 9.0)))[105], 1);
}

// Where every other reading repeats the one before, ten equal ones say nothing: they may be clipped all the same.
TEST(Clipped, WouldNotShowAmongCoarseReadings) {
    const auto coarse = [](std::size_t every) {
        std::vector<double> values = clipped(100, 40, 9.0);
        for (std::size_t i = 1; i < values.size(); i += every) {
            values[i] = values[i] == 9.0 ? 9.0 : values[i - 1] == 9.0 ? 0.0 : values[i - 1];
        }
        return values;
    };
    EXPECT_TRUE(gap::ends_would_show(record_of(coarse(3))));
    EXPECT_EQ(clipped_in(coarse(3)), 40);
    EXPECT_FALSE(gap::ends_would_show(record_of(std::vector<double>(50, 2.0))));
    std::vector<double> steps = clipped(100, 40, 9.0);
    for (double& value : steps) {
        value = value == 9.0 ? 9.0 : 5.0 * std::round(0.2 * value);
    }
    EXPECT_FALSE(gap::ends_would_show(record_of(steps)));
    EXPECT_EQ(clipped_in(steps), 0);
    EXPECT_TRUE(gap::audit({record_of(steps)}).may_clip);
    EXPECT_FALSE(gap::audit({record_of(noisy(400, 12))}).may_clip);
    EXPECT_TRUE(gap::audit({record_of(noisy(400, 12)), record_of(clipped(100, 10, 9.0))}).may_clip);
}

// 100 pairs of equal readings, the highest behind them: with a single one besides, 100 of 200 repeat the one before,
// with two 100 of 201.
TEST(Clipped, WouldShowWhereLessThanHalfRepeats) {
    const auto shows = [](int singles) {
        std::vector<double> values;
        for (int i = 0; i < 200; ++i) {
            values.push_back(0.01 * (i / 2));
        }
        for (int i = 0; i < singles; ++i) {
            values.push_back(2.0 + i);
        }
        values.push_back(9.0);
        return gap::ends_would_show(record_of(values));
    };
    EXPECT_FALSE(shows(1));
    EXPECT_TRUE(shows(2));
}

TEST(Clipped, DoNotCountWhereFiftyOthersDo) {
    const auto left = [](std::size_t count) {
        const auto counts = gap::without_ends({std::vector<char>(400, 1)}, {record_of(clipped(0, count, 9.0))});
        return std::count(counts[0].begin(), counts[0].end(), 1);
    };
    EXPECT_EQ(left(40), 360);
    EXPECT_EQ(left(350), 50);
    EXPECT_EQ(left(351), 400);
    std::vector<char> aside(400, 1);
    std::fill_n(aside.begin() + 200, 100, 0);
    const auto counts = gap::without_ends({aside}, {record_of(clipped(0, 40, 9.0))});
    EXPECT_EQ(std::count(counts[0].begin(), counts[0].end(), 1), 260);
}

TEST(Audit, AsksForLostSigns) {
    std::vector<double> values = noisy(100, 7);
    for (double& value : values) {
        value = std::fabs(value);
    }
    gap::Record record = record_of(values);
    EXPECT_THAT(gap::audit({record}).notes, Not(Contains(HasSubstr("lose the sign"))));
    record.input.back() = -1.0;
    EXPECT_THAT(gap::audit({record}).notes, Contains(HasSubstr("does the sensor lose the sign?")));
    record.output[50] = -1.0;
    EXPECT_THAT(gap::audit({record}).notes, Not(Contains(HasSubstr("lose the sign"))));
}

}  // namespace
