#include "tests/bench/digits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace digits {
namespace {

// By MPFR: Boost's own printing draws a false -Wrestrict from GCC 12 where it is inlined.
std::string text(const Real& number) {
    std::array<char, 80> letters{};
    mpfr_snprintf(letters.data(), letters.size(), "%.40Rg", number.backend().data());
    return letters.data();
}

}  // namespace

void expect_thirty(const Real& found, const Real& expected, const std::string& what) {
    EXPECT_TRUE(abs(found - expected) <= abs(expected) * Real("1e-30"))
        << what << ": expected " << text(expected) << ", found " << text(found);
}

void expect_printed(const Real& found, const std::string& printed, double units, const std::string& what) {
    const std::size_t end = std::min(printed.find('e'), printed.size());
    const int exponent = end == printed.size() ? 0 : std::stoi(printed.substr(end + 1));
    const std::size_t point = std::min(printed.find('.'), end);
    const int decimals = point == end ? 0 : static_cast<int>(end - point - 1);
    EXPECT_TRUE(abs(found - Real(printed)) <= units * pow(Real(10), exponent - decimals))
        << what << ": printed " << printed << ", found " << text(found);
}

}  // namespace digits
