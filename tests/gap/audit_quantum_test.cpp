// The step in which a sensor reads, whatever a logger's digits make of it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/gap/audit_case.hpp"

namespace {

using audit_test::in_units;
using audit_test::noisy;
using audit_test::record_of;
using audit_test::unit;
using audit_test::Values;

double quantum_of(Values output) { return gap::audit({record_of(std::move(output))}).quantum; }

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

}  // namespace
