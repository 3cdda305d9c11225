// What records say of themselves, on records made for it.
#include "gap/drive/audit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gap/drive/clipped.hpp"
#include "gap/drive/ends.hpp"

namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

gap::Record record_of(std::vector<double> output) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 0.1;
    for (std::size_t i = 0; i < output.size(); ++i) {
        record.time_s.push_back(0.1 * static_cast<double>(i));
        record.input.push_back(1.0);
    }
    record.output = std::move(output);
    return record;
}

std::vector<double> noisy(std::size_t count, unsigned seed, double size = 1.0) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(0.0, size);
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(normal(engine));
    }
    return values;
}

double quantum_of(const std::vector<double>& output) { return gap::audit({record_of(output)}).quantum; }

TEST(AuditQuantum, IsTheLatticeWhereverItBegins) {
    std::vector<double> values = noisy(400, 1);
    for (double& value : values) {
        value = 0.123 + 0.05 * std::round(value / 0.05);
    }
    EXPECT_NEAR(quantum_of(values), 0.05, 1e-9);
    // One reading of a hundred may lie off it, and no more.
    for (std::size_t i = 0; i < 400; i += 40) {
        values[i] += 0.02;
    }
    EXPECT_EQ(quantum_of(values), 0.0);
    EXPECT_EQ(quantum_of(noisy(400, 2)), 0.0);
    // The digits of a file are no step: it is below a hundred-thousandth of the span.
    std::vector<double> fine{0.0, 1.0, 3.0, 4.0, 200000.0, 200001.0, 7.0};
    EXPECT_EQ(quantum_of(fine), 0.0);
    fine[4] = 90000.0;
    fine[5] = 90001.0;
    EXPECT_NEAR(quantum_of(fine), 1.0, 1e-6);
    EXPECT_EQ(quantum_of(std::vector<double>(50, 2.0)), 0.0);
}

// Readings that go up and down by a step of 0.05, and far above them once some that lie a fifth of a step beside.
TEST(AuditQuantum, OfOneLevelInAHundredMayLieBeside) {
    const auto with_beside = [](int levels, int beside) {
        std::vector<double> values;
        for (int turn = 0; turn < 20; ++turn) {
            for (int i = 0; i < levels - beside; ++i) {
                values.push_back(0.05 * (turn % 2 == 0 ? i : levels - beside - 1 - i));
            }
        }
        for (int i = 0; i < beside; ++i) {
            values.push_back(0.05 * (150.2 + 50.0 * i));
            values.push_back(0.0);
        }
        return quantum_of(values);
    };
    EXPECT_NEAR(with_beside(100, 1), 0.05, 1e-4);
    EXPECT_EQ(with_beside(100, 2), 0.0);
    EXPECT_EQ(with_beside(99, 1), 0.0);
}

// A logger's last digit rounds a sensor's steps: 0.3223 is 0.32 or 0.33.
TEST(AuditQuantum, IsSeenThroughALoggersDigits) {
    std::vector<double> values = noisy(400, 3);
    for (double& value : values) {
        value = std::round(0.3223 * std::round(4.0 * value) * 100.0) / 100.0;
    }
    EXPECT_NEAR(quantum_of(values), 0.3223, 2e-3);
}

// Readings with a digit behind the point are no whole numbers, however large they are: steps of 20 and 20.9 are none.
TEST(AuditQuantum, HasTheDigitsOfLargeReadings) {
    std::vector<double> values;
    for (int i = 0; i < 200; ++i) {
        values.push_back(2e6 + (i % 4 == 0 ? 0.0 : i % 4 == 2 ? 40.9 : 20.0));
    }
    EXPECT_EQ(quantum_of(values), 0.0);
    for (double& value : values) {
        value = std::round(value);  // logged without the digit
    }
    EXPECT_NEAR(quantum_of(values), 20.5, 0.2);
}

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
