// What every room uses.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/nearest_name.hpp"
#include "base/rounded_up.hpp"

namespace {

TEST(RoundedUp, IsTheLeastNumberOfThreeDigitsThatIsNotBelow) {
    EXPECT_EQ(base::rounded_up(0.00173273), "0.00174");
    EXPECT_EQ(base::rounded_up(0.00173), "0.00173");
    EXPECT_EQ(base::rounded_up(9.991), "10");
    EXPECT_EQ(base::rounded_up(1.2e-7, 1), "2e-07");
    EXPECT_EQ(base::rounded_up(0.0), "0");
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> exponent(-12.0, 4.0);
    for (int i = 0; i < 10000; ++i) {
        const double bound = std::pow(10.0, exponent(random));
        const double printed = std::stod(base::rounded_up(bound));
        ASSERT_GE(printed, bound);
        ASSERT_LT(printed, bound * 1.01);
    }
}

TEST(NearestName, TakesTheFewestLetters) {
    const std::vector<std::string> names = {"backlash", "end_stop", "gain_error", "gain_drift"};
    EXPECT_EQ(base::nearest_name("bcklash", names), "backlash");
    EXPECT_EQ(base::nearest_name("endstop", names), "end_stop");
    EXPECT_EQ(base::nearest_name("gain_erorr", names), "gain_error");
    EXPECT_EQ(base::letters_between("ab", "ba"), 1U);
    EXPECT_EQ(base::letters_between("", "abc"), 3U);
    EXPECT_EQ(base::letters_between("kitten", "sitting"), 3U);
}

}  // namespace
