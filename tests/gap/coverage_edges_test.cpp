// What validation has and training lacks, at the edge of each rule: of readings without noise, or of a known one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "gap/drive/audit.hpp"
#include "gap/drive/coverage.hpp"

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;
using Values = std::vector<double>;

constexpr double interval_s = 0.1;

gap::Record record_of(Values input, Values output) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = interval_s;
    for (std::size_t i = 0; i < output.size(); ++i) {
        record.time_s.push_back(interval_s * static_cast<double>(i));
    }
    record.input = std::move(input);
    record.output = std::move(output);
    return record;
}

std::vector<std::string> told(const gap::Record& train, const gap::Record& validate) {
    return gap::extrapolated({train}, {validate});
}

// --- Directions.

// Straight from place to place, fifty readings each, with some at each place.
Values path(const Values& places) {
    Values values;
    for (std::size_t p = 0; p + 1 < places.size(); ++p) {
        values.insert(values.end(), 10, places[p]);
        for (int i = 0; i < 50; ++i) {
            values.push_back(places[p] + (places[p + 1] - places[p]) * i / 50.0);
        }
    }
    values.insert(values.end(), 10, places.back());
    return values;
}

gap::Record moving(const Values& output) { return record_of(Values(output.size(), 1.0), output); }

Values mirrored(Values values) {
    for (double& value : values) {
        value = 1.0 - value;
    }
    return values;
}

// Whether training of the one lacks the falls of the other; rises are told alike.
bool lacks_falls(const Values& train, const Values& validate) {
    const auto falls = told(moving(train), moving(validate));
    const auto rises = told(moving(mirrored(train)), moving(mirrored(validate)));
    const bool lacks = std::ranges::find(falls, "falling output") != falls.end();
    EXPECT_EQ(std::ranges::find(rises, "rising output") != rises.end(), lacks);
    return lacks;
}

// A fall of a tenth of the span is asked for, at once: not by several.
TEST(CoverageEdges, AFallIsOfATenthOfTheSpan) {
    const Values rise = path({0.0, 1.0});
    EXPECT_FALSE(lacks_falls(rise, path({0.0, 1.0, 0.9005})));
    EXPECT_TRUE(lacks_falls(rise, path({0.0, 1.0, 0.8995})));
    EXPECT_FALSE(lacks_falls(rise, path({0.0, 0.5, 0.42, 0.8, 0.72, 1.0, 0.92})));
    EXPECT_TRUE(lacks_falls(rise, path({0.5, 0.3995, 1.0})));  // as it begins
    EXPECT_FALSE(lacks_falls(rise, path({0.5, 0.4005, 1.0})));
}

// A quarter of it is enough, in several.
TEST(CoverageEdges, ItIsKnownByAQuarter) {
    const Values falls = path({0.0, 1.0, 0.2});
    EXPECT_TRUE(lacks_falls(path({0.0, 0.5, 0.301, 1.0}), falls));
    EXPECT_FALSE(lacks_falls(path({0.0, 0.5, 0.299, 1.0}), falls));
    EXPECT_FALSE(lacks_falls(path({0.0, 0.5, 0.399, 0.8, 0.699, 1.0}), falls));
    EXPECT_TRUE(lacks_falls(path({0.0, 0.5, 0.401, 0.8, 0.701, 1.0}), falls));
    EXPECT_FALSE(lacks_falls(path({0.3, 0.099, 1.0}), falls));  // as it begins
    EXPECT_FALSE(lacks_falls(path({0.0, 1.0, 0.799}), falls));  // as it ends
}

// Three hundredths of the span are a turn.
TEST(CoverageEdges, ATurnIsOfThreeHundredths) {
    const Values falls = path({0.0, 1.0, 0.89});
    EXPECT_TRUE(lacks_falls(path({0.0, 0.5, 0.4701, 1.0}), falls));
    EXPECT_FALSE(lacks_falls(path({0.0, 0.5, 0.4699, 1.0}), falls));
    // Three of a hundred are none yet.
    EXPECT_TRUE(lacks_falls(path({0.0, 50.0, 47.0, 100.0}), path({0.0, 100.0, 89.0})));
    EXPECT_TRUE(lacks_falls(path({50.0, 47.0, 100.0}), path({0.0, 100.0, 89.0})));
}

// Or six times what differs from reading to reading, in either.
TEST(CoverageEdges, ATurnIsBeyondNoise) {
    const auto with_noise = [](const Values& places, double size) {
        Values values = path(places);
        std::mt19937 random(3);
        std::normal_distribution<double> normal(0.0, size);
        const Values noise = [&] {
            Values drawn(400);
            std::ranges::generate(drawn, [&] { return normal(random); });
            return drawn;
        }();
        // A level with noise before the clean path.
        values.insert(values.begin(), noise.begin(), noise.end());
        for (std::size_t i = 0; i < noise.size(); ++i) {
            values[i] += places.front();
        }
        return values;
    };
    constexpr double size = 0.02;
    const double noise = gap::audit({moving(with_noise({0.0, 0.5, 0.4, 1.0}, size))}).noise;
    ASSERT_GT(6.0 * noise, 0.04);
    ASSERT_LT(6.0 * noise, 0.124);
    for (const double turn : {0.997, 1.003}) {
        const Values train = with_noise({0.0, 0.5, 0.5 - turn * 6.0 * noise, 1.0}, size);
        ASSERT_NEAR(gap::audit({moving(train)}).noise, noise, 1e-3 * noise);
        // A fall of that size is known as a quarter of another one.
        const Values asked = path({0.0, 1.0, 1.0 - 3.9 * 6.0 * noise});
        const auto found = told(moving(train), moving(asked));
        EXPECT_EQ(std::ranges::find(found, "falling output") != found.end(), turn < 1.0) << turn;
    }
}

// --- Levels.

// The same output whatever the input.
gap::Record driven(const Values& input) {
    Values output;
    for (std::size_t i = 0; i < input.size(); ++i) {
        output.push_back(std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / 50.0));
    }
    return record_of(input, output);
}

// A level is beyond those of training by a twentieth of the span of both; a hundredth of the readings does not count.
TEST(CoverageEdges, LevelsAreBeyondByATwentieth) {
    const auto levels = [](double low, double high, std::size_t of_high = 150) {
        Values input(300, low);
        std::fill_n(input.begin(), of_high, high);
        return driven(input);
    };
    const gap::Record train = levels(0.0, 1.0);
    const auto input_told = [&](const gap::Record& validate) {
        auto all = told(train, validate);
        std::erase_if(all, [](const std::string& one) { return !one.starts_with("input"); });
        return all;
    };
    EXPECT_THAT(input_told(levels(0.0, 1.052)), ElementsAre());
    EXPECT_THAT(input_told(levels(0.0, 1.0535)), ElementsAre("input above 1"));
    EXPECT_THAT(input_told(levels(-0.052, 1.0)), ElementsAre());
    EXPECT_THAT(input_told(levels(-0.0535, 1.0)), ElementsAre("input below 0"));
    EXPECT_THAT(input_told(levels(0.0, 2.0, 3)), ElementsAre());
    EXPECT_THAT(input_told(levels(0.0, 2.0, 4)), ElementsAre("input above 1"));
    EXPECT_THAT(input_told(levels(-1.0, 0.0, 297)), ElementsAre());
    EXPECT_THAT(input_told(levels(-1.0, 0.0, 296)), ElementsAre("input below 0"));
}

// Or by four times the noise of the readings.
TEST(CoverageEdges, LevelsAreBeyondNoise) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal(0.0, 1.0);
    Values noise(600);
    std::ranges::generate(noise, [&] { return normal(random); });
    const gap::Record train = moving(noise);
    const auto [low, high] = std::ranges::minmax(noise);
    const double beyond = 4.0 * gap::audit({train}).noise;
    const auto found = [&](double level) {
        Values values = noise;
        std::fill_n(values.begin(), 20, level);
        return told(train, moving(values));
    };
    const auto above = Contains(testing::StartsWith("output above"));
    const auto below = Contains(testing::StartsWith("output below"));
    EXPECT_THAT(found(high + 0.997 * beyond), Not(above));
    EXPECT_THAT(found(high + 1.003 * beyond), above);
    EXPECT_THAT(found(low - 0.997 * beyond), Not(below));
    EXPECT_THAT(found(low - 1.003 * beyond), below);
}

// A hole of a fifth of the span in what training had, and more than a tenth of the readings well within it.
TEST(CoverageEdges, LevelsAreBetweenThoseOfTraining) {
    const auto train = [](double hole) {
        Values input;
        for (int i = 0; i <= 100; ++i) {
            input.push_back(0.4 * i / 100.0);
            input.push_back(0.4 + hole + (0.6 - hole) * i / 100.0);
        }
        input.resize(310, 0.0);
        return driven(input);
    };
    const auto validate = [](std::size_t within, double level) {
        Values input(310, 0.0);
        input.back() = 1.0;
        std::fill_n(input.begin(), within, level);
        return driven(input);
    };
    const auto hole = Contains(testing::StartsWith("input between 0.4 and"));
    EXPECT_THAT(told(train(0.199), validate(200, 0.5)), Not(hole));
    EXPECT_THAT(told(train(0.201), validate(200, 0.5)), hole);
    EXPECT_THAT(told(train(0.3), validate(31, 0.5)), Not(hole));
    EXPECT_THAT(told(train(0.3), validate(32, 0.5)), Contains("input between 0.4 and 0.7"));
    EXPECT_THAT(told(train(0.3), validate(200, 0.4495)), Not(hole));
    EXPECT_THAT(told(train(0.3), validate(200, 0.4505)), hole);
    EXPECT_THAT(told(train(0.3), validate(200, 0.6495)), hole);
    EXPECT_THAT(told(train(0.3), validate(200, 0.6505)), Not(hole));
}

// --- In other units, and at the edges themselves.

// Everything goes by the spans, whatever they are.
TEST(CoverageEdges, AreOfTheSpanInAnyUnit) {
    for (const double unit : {0.125, 8.0}) {
        const auto in_units = [&](Values values) {
            for (double& value : values) {
                value *= unit;
            }
            return values;
        };
        const Values rise = in_units(path({0.0, 1.0}));
        EXPECT_FALSE(lacks_falls(rise, in_units(path({0.0, 1.0, 0.9005})))) << unit;
        EXPECT_TRUE(lacks_falls(rise, in_units(path({0.0, 1.0, 0.8995})))) << unit;
        const Values falls = in_units(path({0.0, 1.0, 0.89}));
        EXPECT_TRUE(lacks_falls(in_units(path({0.0, 0.5, 0.4701, 1.0})), falls)) << unit;
        EXPECT_FALSE(lacks_falls(in_units(path({0.0, 0.5, 0.4699, 1.0})), falls)) << unit;
        for (const double hole : {0.199, 0.201}) {
            Values train;
            Values validate(303, 0.5);
            for (int i = 0; i <= 100; ++i) {
                train.push_back(0.4 * i / 100.0);
                train.push_back(0.4 + hole + (0.6 - hole) * i / 100.0);
                train.push_back(0.0);
            }
            const auto found = told(driven(in_units(train)), driven(in_units(validate)));
            EXPECT_EQ(std::ranges::any_of(found, [](const auto& one) { return one.starts_with("input between"); }),
                      hole > 0.2)
                << unit;
        }
    }
}

// A tenth is enough of a fall, and a quarter of one to know it; a twentieth beyond is none, nor a hole of a fifth.
TEST(CoverageEdges, AreWithinWhatIsKnown) {
    EXPECT_TRUE(lacks_falls(path({0.0, 10.0}), path({0.0, 10.0, 9.0})));
    EXPECT_FALSE(lacks_falls(path({0.0, 10.0, 9.0}), path({0.0, 10.0, 6.0})));
    const auto inputs = [](const Values& train, const Values& validate) {
        const auto repeated = [](const Values& levels) {
            Values input(300);
            for (std::size_t i = 0; i < input.size(); ++i) {
                input[i] = levels[i % levels.size()];
            }
            return driven(input);
        };
        auto all = told(repeated(train), repeated(validate));
        std::erase_if(all, [](const std::string& one) { return !one.starts_with("input"); });
        return all;
    };
    EXPECT_THAT(inputs({0.0, 4.0, 8.0, 12.0, 16.0, 19.0}, {0.0, 20.0}), ElementsAre());
    EXPECT_THAT(inputs({1.0, 4.0, 8.0, 12.0, 16.0, 20.0}, {0.0, 20.0}), ElementsAre());
    EXPECT_THAT(inputs({0.0, 2.0, 4.0, 6.0, 8.0, 10.0}, {3.0}), ElementsAre());
    // The first level may be the one that is far from the others, in a single reading.
    Values first(300, 8.0);
    first.front() = 0.0;
    first.back() = 10.0;
    EXPECT_THAT(told(driven(first), driven(Values(300, 4.0))), Contains("input between 0 and 8"));
    // A hundredth of 299 readings are two.
    Values high(299, 0.0);
    std::fill_n(high.begin(), 3, 2.0);
    Values known(299, 0.0);
    known.back() = 1.0;
    EXPECT_THAT(told(driven(known), driven(high)), Contains("input above 1"));
}

// --- Frequencies.

// Waves of whole periods, so many in 58.1 s: 0.10 Hz, 0.29 Hz and 1.0 Hz, each in a band of its own. The first band
// begins at 0.9 of a period in the record; half-decades from there are 0.0155, 0.049, 0.155, 0.49 and 1.55 Hz.
constexpr int periods[] = {6, 17, 60};

gap::Record waves(const Values& amplitudes, int records_long = 1) {
    const int last = 581 * records_long;
    Values output;
    for (int i = 0; i <= last; ++i) {
        output.push_back(0.0);
        for (std::size_t w = 0; w < amplitudes.size(); ++w) {
            output.back() += amplitudes[w] * std::cos(2.0 * std::numbers::pi * periods[w] * records_long * i /
                                                      static_cast<double>(last));
        }
    }
    return record_of(Values(output.size(), 1.0), output);
}

std::vector<std::string> frequencies(const std::vector<gap::Record>& train, const gap::Record& validate) {
    auto all = gap::extrapolated(train, {validate});
    std::erase_if(all, [](const std::string& one) { return !one.ends_with("Hz"); });
    return all;
}

TEST(CoverageEdges, FrequenciesAreToldByHalfDecades) {
    // 0.1549 and 1.549 Hz.
    EXPECT_THAT(frequencies({waves({1.0, 0.0, 0.0})}, waves({1.0, 1.0, 0.0})), ElementsAre("faster than 0.15 Hz"));
    EXPECT_THAT(frequencies({waves({0.0, 0.0, 1.0})}, waves({0.0, 1.0, 1.0})), ElementsAre("slower than 0.49 Hz"));
    EXPECT_THAT(frequencies({waves({0.0, 1.0, 0.0})}, waves({1.0, 1.0, 0.0})), ElementsAre("slower than 0.15 Hz"));
    EXPECT_THAT(frequencies({waves({1.0, 0.0, 1.0})}, waves({1.0, 1.0, 1.0})), ElementsAre("between 0.15 and 0.49 Hz"));
    EXPECT_THAT(frequencies({waves({1.0, 0.0, 0.0})}, waves({1.0, 1.0, 1.0})), ElementsAre("faster than 0.15 Hz"));
    EXPECT_THAT(frequencies({waves({0.0, 1.0, 0.0})}, waves({1.0, 1.0, 1.0})),
                ElementsAre("slower than 0.15 Hz", "faster than 0.49 Hz"));
    EXPECT_THAT(frequencies({waves({1.0, 1.0, 1.0})}, waves({1.0, 1.0, 1.0})), ElementsAre());
}

// From a fiftieth of what validation has in all; a twentieth of it is known. Squares of amplitudes.
TEST(CoverageEdges, FrequenciesHaveTheirShare) {
    EXPECT_THAT(frequencies({waves({1.0, 0.0})}, waves({1.0, 0.1422})), ElementsAre());
    EXPECT_THAT(frequencies({waves({1.0, 0.0})}, waves({1.0, 0.1436})), ElementsAre("faster than 0.15 Hz"));
    EXPECT_THAT(frequencies({waves({1.0, 0.2228})}, waves({1.0, 1.0})), ElementsAre("faster than 0.15 Hz"));
    EXPECT_THAT(frequencies({waves({1.0, 0.2244})}, waves({1.0, 1.0})), ElementsAre());
    // Several records by their lengths: a third of these.
    EXPECT_THAT(frequencies({waves({1.0, 0.0}, 2), waves({1.0, 0.386})}, waves({1.0, 1.0})),
                ElementsAre("faster than 0.24 Hz"));
    EXPECT_THAT(frequencies({waves({1.0, 0.0}, 2), waves({1.0, 0.389})}, waves({1.0, 1.0})), ElementsAre());
}

// What an output ends away from its beginning is no frequency of it.
TEST(CoverageEdges, FrequenciesAreBesideADrift) {
    gap::Record drifting = waves({1.0, 1.0});
    for (std::size_t i = 0; i < drifting.size(); ++i) {
        drifting.output[i] += 10.0 * drifting.time_s[i] / drifting.time_s.back();
    }
    EXPECT_THAT(frequencies({waves({1.0, 1.0})}, drifting), ElementsAre());
    EXPECT_THAT(frequencies({drifting}, waves({1.0, 1.0, 1.0})), ElementsAre("faster than 0.49 Hz"));
}

// What training has much of, a fiftieth of that, says on which side of it something is missing.
TEST(CoverageEdges, FrequenciesAreBesideWhatTrainingHas) {
    const gap::Record asked = waves({0.0, 1.0});
    EXPECT_THAT(frequencies({waves({0.1405, 0.0, 1.0})}, asked), ElementsAre("slower than 0.49 Hz"));
    EXPECT_THAT(frequencies({waves({0.1424, 0.0, 1.0})}, asked), ElementsAre("between 0.15 and 0.49 Hz"));
    EXPECT_THAT(frequencies({waves({1.0, 0.0, 0.1405})}, asked), ElementsAre("faster than 0.15 Hz"));
    EXPECT_THAT(frequencies({waves({1.0, 0.0, 0.1424})}, asked), ElementsAre("between 0.15 and 0.49 Hz"));
}

// Stamps may begin anywhere.
TEST(CoverageEdges, FrequenciesAreThoseOfAnyTime) {
    const auto later = [](gap::Record record) {
        for (double& t : record.time_s) {
            t += 1000.0;
        }
        return record;
    };
    EXPECT_THAT(frequencies({later(waves({1.0, 0.0, 0.0}))}, later(waves({1.0, 1.0, 0.0}))),
                ElementsAre("faster than 0.15 Hz"));
    EXPECT_THAT(frequencies({later(waves({1.0, 0.0, 1.0}))}, later(waves({1.0, 1.0, 1.0}))),
                ElementsAre("between 0.15 and 0.49 Hz"));
}

}  // namespace
