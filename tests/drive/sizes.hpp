// Sizes of the effects of blind cases, held to the extremes of many draws: a size is meant up to 15 % more or less.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "drive/stand/blind/effects.hpp"
#include "tests/drive/seen.hpp"

namespace test {

namespace blind = stand::blind;
using blind::Parameters;
using stand::Chance;

/// Within the bounds, and up to them: by less than half a per cent of a bound, as plants are made of rounded numbers.
inline void expect_fills(const Seen& range, double low, double high, const std::string& what) {
    const double near_low = 4e-3 * std::max(std::fabs(low), 0.5 * (high - low));
    const double near_high = 4e-3 * std::max(std::fabs(high), 0.5 * (high - low));
    EXPECT_GE(range.least, low - 3e-3 * std::fabs(low)) << what;
    EXPECT_LE(range.least, low + near_low) << what;
    EXPECT_LE(range.most, high + 3e-3 * std::fabs(high)) << what;
    EXPECT_GE(range.most, high - near_high) << what;
}

using Draw = std::function<Parameters(const std::string& effect, blind::EffectSize size, Chance& chance)>;
using Measure = std::function<double(const Parameters& drawn)>;

enum class Sides { one, both };

struct Row {
    const char* effect;
    double small, clear, large;
    Sides sides;
    Measure size_of;  // in the unit of the sizes beside it
};

/// What is drawn evenly between two bounds, whatever the size.
struct Spread {
    const char* effect;
    double low, high;
    Measure of;
};

inline void expect_sizes(const std::vector<Row>& rows, const Draw& draw) {
    for (const Row& row : rows) {
        Chance chance(5, 17);
        for (const auto& [size, middle] :
             {std::pair(blind::EffectSize::small, row.small), std::pair(blind::EffectSize::clear, row.clear),
              std::pair(blind::EffectSize::large, row.large)}) {
            Seen drawn;
            int above = 0;
            constexpr int draws = 800;
            for (int k = 0; k < draws; ++k) {
                const double value = row.size_of(draw(row.effect, size, chance));
                drawn(std::fabs(value));
                above += value > 0.0 ? 1 : 0;
            }
            expect_fills(drawn, 0.85 * middle, 1.15 * middle, row.effect);
            if (row.sides == Sides::one) {
                EXPECT_EQ(above, draws) << row.effect;
            } else {
                EXPECT_NEAR(above, draws / 2, draws / 16) << row.effect;
            }
        }
    }
}

inline void expect_spreads(const std::vector<Spread>& spreads, const Draw& draw) {
    for (const Spread& spread : spreads) {
        Chance chance(7, 17);
        Seen drawn;
        for (int k = 0; k < 3000; ++k) {
            drawn(spread.of(draw(spread.effect, blind::EffectSize::clear, chance)));
        }
        expect_fills(drawn, spread.low, spread.high, spread.effect);
    }
}

inline Measure number(const char* name, double unit) {
    return [=](const Parameters& drawn) { return drawn.at(name) / unit; };
}
inline Measure share_off(const char* name, double unit) {
    return [=](const Parameters& drawn) { return 1.0 - drawn.at(name) / unit; };
}
inline Measure larger(const char* one, const char* other, double unit) {
    return [=](const Parameters& drawn) {
        const double a = drawn.at(one);
        const double b = drawn.at(other);
        return std::max(a, b) / unit * (a > b ? 1.0 : -1.0);
    };
}
inline Measure smaller_part(const char* one, const char* other) {
    return [=](const Parameters& drawn) {
        return std::min(drawn.at(one), drawn.at(other)) / std::max(drawn.at(one), drawn.at(other));
    };
}
inline Measure growth(const char* name) {
    return [=](const Parameters& drawn) { return std::log(drawn.at(name)); };
}
inline Measure one_over(const char* name, double unit) {
    return [=](const Parameters& drawn) { return unit / drawn.at(name); };
}

}  // namespace test
