// Where what an audit counts begins and ends: records just below and just above.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "gap/drive/audit.hpp"

namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using Values = std::vector<double>;

gap::Record record_of(Values output) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 0.125;
    for (std::size_t i = 0; i < output.size(); ++i) {
        record.time_s.push_back(0.125 * static_cast<double>(i));
        record.input.push_back(1.0);
    }
    record.output = std::move(output);
    return record;
}

double quantum_of(Values output) { return gap::audit({record_of(std::move(output))}).quantum; }

Values noisy(std::size_t count, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    Values values(count);
    for (double& value : values) {
        value = normal(engine);
    }
    return values;
}

// In a unit that has more than six digits: no logger rounded these.
constexpr double unit = 0.123456789;

Values in_units(Values numbers) {
    for (double& number : numbers) {
        number *= unit;
    }
    return numbers;
}

// 0, 1, 0, 1, ...
Values to_and_fro(std::size_t count) {
    Values numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
        numbers[i] = static_cast<double>(i % 2);
    }
    return numbers;
}

// Steps of 32.23 last digits, whichever power of ten those are.
TEST(AuditQuantum, IsSeenThroughAnyLastDigit) {
    for (const double digit : {1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        Values values = noisy(400, 3);
        for (double& value : values) {
            value = std::round(32.23 * std::round(4.0 * value)) * digit;
        }
        EXPECT_NEAR(quantum_of(values) / digit, 32.23, 0.2) << digit;
    }
}

// A reading is a multiple of the last digit to a millionth of itself and of the digit, a hundredth of that at most.
// Without a last digit steps of 32 and 33 are no multiples of one.
TEST(AuditQuantum, HasALastDigitToSinglePrecision) {
    const auto steps = [](double from, double off) {
        Values values;
        for (const double number : {0.0, 32.0, 65.0, 97.0, 129.0, 161.0, 193.0, 161.0, 97.0, 32.0}) {
            values.push_back(from + number);
        }
        for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{9}}) {
            values[i] += off * 1e-6 * (1.0 + values[i]);
        }
        return quantum_of(values);
    };
    EXPECT_NEAR(steps(0.0, 0.0), 32.2, 0.2);
    EXPECT_NEAR(steps(0.0, 0.99), 32.2, 0.2);
    EXPECT_EQ(steps(0.0, 1.005), 0.0);
    const auto at_most = [](double off) {
        Values values;
        for (const double number : {0.0, 32.0, 65.0, 97.0, 129.0, 161.0, 193.0, 161.0, 97.0, 32.0}) {
            values.push_back(5e6 + number + off);
        }
        return quantum_of(values);
    };
    EXPECT_NEAR(at_most(0.00995), 32.2, 0.2);
    EXPECT_EQ(at_most(0.01005), 0.0);
}

// A digit of a tenth of the step rounds nothing, a smaller one does: here steps of 10 1/2 and of 11 1/2.
TEST(AuditQuantum, IsRoundedByLessThanATenth) {
    EXPECT_EQ(quantum_of({0.0, 11.0, 21.0, 32.0, 42.0, 53.0, 63.0}), 0.0);
    EXPECT_NEAR(quantum_of({0.0, 12.0, 23.0, 35.0, 46.0, 58.0, 69.0}), 11.5, 0.1);
}

// The smallest step may be the first one.
TEST(AuditQuantum, IsTheSmallestStep) {
    EXPECT_NEAR(quantum_of(in_units({0.0, 1.0, 3.0, 5.0, 7.0, 9.0})), unit, 1e-9);
    // A hundred-thousandth of the span is one, still.
    EXPECT_NEAR(quantum_of({0.0, 1.0, 3.0, 4.0, 99999.0, 100000.0, 7.0}), 1.0, 1e-6);
}

// Of a hundred steps one may be no multiple to a fiftieth of it.
TEST(AuditQuantum, OfOneStepInAHundredMayBeNoMultiple) {
    EXPECT_NEAR(quantum_of(in_units({0.0, 1.0, 0.0, 1.0199, 0.0, 1.0, 0.0})), unit, 0.02 * unit);
    EXPECT_EQ(quantum_of(in_units({0.0, 1.0, 0.0, 1.0201, 0.0, 1.0, 0.0})), 0.0);
    Values numbers = to_and_fro(101);
    numbers.back() = -0.05;  // from 1 at the end: one of 100
    EXPECT_NEAR(quantum_of(in_units(numbers)), unit, 0.06 * unit);
    numbers = to_and_fro(200);
    numbers[101] = 1.05;  // two of 199
    EXPECT_EQ(quantum_of(in_units(numbers)), 0.0);
}

// Of 99 levels the one in the middle lies beside the others' lattice: a line through all of them leaves 98/99 of that,
// and may leave a tenth of a step.
TEST(AuditQuantum, OfALevelIsATenthOfAStepBesideAtMost) {
    const auto with_middle = [](double beside) {
        Values numbers;
        for (int i = 0; i <= 98; ++i) {
            if (i != 49) {
                numbers.push_back(i);
            }
        }
        numbers.push_back(49.0 + beside);
        return quantum_of(in_units(numbers));
    };
    EXPECT_NEAR(with_middle(0.1005), unit, 1e-9);
    EXPECT_EQ(with_middle(0.1015), 0.0);
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

// A gap is longer than five usual intervals, between the first stamps as anywhere.
TEST(AuditNotes, SayWhereStampsAreFarApart) {
    const auto notes = [](std::size_t at, double by_s) {
        gap::Record record = record_of(noisy(64, 29));
        for (std::size_t i = at; i < record.size(); ++i) {
            record.time_s[i] += by_s;
        }
        return gap::audit({record}).notes;
    };
    EXPECT_THAT(notes(1, 0.5), IsEmpty());
    EXPECT_THAT(notes(1, 0.502), Contains(HasSubstr("made: a gap of 0.627 s between stamps, usually 0.125 s")));
    EXPECT_THAT(notes(63, 0.502), Contains(HasSubstr("made: a gap of 0.627 s between stamps")));
}

}  // namespace
