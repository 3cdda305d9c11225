// What the records of blind cases hold, as docs/blind-cases.md says: noise, levels, excitations, and what a
// logger makes of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "drive/log.hpp"
#include "drive/model_file.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/series.hpp"
#include "drive/stand/blind/without_model.hpp"
#include "drive/stand/chance.hpp"

namespace {

namespace blind = stand::blind;
using blind::Class;

double highest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }
double lowest(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

// Noise of 0.2 to 1 % of the deviation, other excitations in validation than in training, at up to a quarter less; on a
// new profile at twice the level.
TEST(BlindRecords, AreWhatTheReadmeSays) {
    std::set<double> lengths;
    for (std::size_t number = 1; number <= 10; ++number) {
        const bool new_profile = number % 2 == 0;
        const auto made = blind::make_case({Class::none, {}, {}, new_profile}, 41, number);
        const drive::Log train = drive::parse_log(made.train, "train.csv");
        const drive::Log validate = drive::parse_log(made.validate, "validate.csv");
        EXPECT_NE(made.truth.train, made.truth.validate);
        EXPECT_FALSE(blind::has_one_level(made.truth.train) && blind::has_one_level(made.truth.validate));
        const double share = made.truth.noise / blind::deviation_of(train.output);
        EXPECT_GT(share, 0.00199);
        EXPECT_LT(share, 0.01005);
        EXPECT_EQ(made.truth.train_deviation, 0.0);
        EXPECT_EQ(made.truth.validate_deviation, 0.0);
        EXPECT_NEAR(made.truth.noise_floor, made.truth.noise / blind::deviation_of(validate.output),
                    0.3 * made.truth.noise_floor);
        if (made.truth.train != "levels" && made.truth.validate != "levels") {
            const double ratio = highest(validate.input) / highest(train.input);
            if (new_profile) {
                EXPECT_NEAR(ratio, 2.0, 2e-3) << number;
            } else {
                EXPECT_GE(ratio, 0.749) << number;
                EXPECT_LE(ratio, 1.001) << number;
            }
        }
        EXPECT_EQ(lowest(train.input), 0.0);
        EXPECT_EQ(train.input.front(), 0.0);
        const double interval_s = train.time_s.back() / static_cast<double>(train.time_s.size() - 1);
        EXPECT_NEAR(validate.time_s.back() / static_cast<double>(validate.time_s.size() - 1) / interval_s, 1.0, 1e-3);
        const double part =
            static_cast<double>(validate.time_s.size() - 1) / static_cast<double>(train.time_s.size() - 1);
        EXPECT_TRUE(std::fabs(part - 1.0) < 1e-3 || std::fabs(part - 0.75) < 1e-3) << part;
        lengths.insert(part > 0.9 ? 1.0 : 0.75);
        if (made.truth.plant != "stand") {
            EXPECT_NEAR(drive::parse_model(made.model, "m").sample_time_s.value(), interval_s, 1e-3 * interval_s);
        }
    }
    EXPECT_EQ(lengths.size(), 2U);
}

// At one level: the same one in both records, for what bends the input; a lag at any.
TEST(BlindRecords, OfWhatIsTheSameHoldOneLevel) {
    for (std::size_t number = 1; number <= 4; ++number) {
        const auto made =
            blind::make_case({Class::same, {"supply_sag"}, {blind::EffectSize::clear}, false}, 43, number);
        EXPECT_TRUE(blind::has_one_level(made.truth.train) && blind::has_one_level(made.truth.validate));
        EXPECT_NE(made.truth.train, made.truth.validate);
        EXPECT_EQ(highest(drive::parse_log(made.train, "t").input),
                  highest(drive::parse_log(made.validate, "v").input));
        EXPECT_THAT(made.truth.required, testing::UnorderedElementsAre("gain_error", "supply_sag"));
        EXPECT_THAT(made.truth.allowed,
                    testing::UnorderedElementsAre("gain_error", "input_saturation", "input_dead_zone", "input_curve",
                                                  "supply_sag", "start_up_threshold"));
        EXPECT_TRUE(made.truth.parameters[0].contains("resistance"));
    }
    const auto gain = blind::make_case({Class::same, {"gain_error"}, {blind::EffectSize::clear}, false}, 43, 9);
    EXPECT_EQ(gain.truth.required, std::vector<std::string>{"gain_error"});
}

// An event's place is that in the validation record, from its beginning to its end.
TEST(BlindRecords, SayWhereTheirEventsLie) {
    const auto blown =
        blind::make_case({Class::single, {"load_disturbance"}, {blind::EffectSize::large}, false}, 44, 1);
    EXPECT_EQ(blown.truth.from_s, blown.truth.parameters[0].at("from_s"));
    EXPECT_EQ(blown.truth.to_s, blown.truth.parameters[0].at("to_s"));
    const double until_s = drive::parse_log(blown.validate, "v").time_s.back();
    EXPECT_GE(blown.truth.from_s, 0.149 * until_s);
    EXPECT_LE(blown.truth.to_s, 0.901 * until_s);
    const auto missed = blind::make_case({Class::single, {"missed_counts"}, {blind::EffectSize::large}, false}, 44, 2);
    EXPECT_EQ(missed.truth.from_s, missed.truth.parameters[0].at("at_s"));
    EXPECT_NEAR(missed.truth.to_s / drive::parse_log(missed.validate, "v").time_s.back(), 1.0, 2e-3);
    // What bends the input is asked at several levels, and not by two of them alone.
    for (std::size_t number = 1; number <= 4; ++number) {
        const auto bent =
            blind::make_case({Class::single, {"input_curve"}, {blind::EffectSize::large}, false}, 45, number);
        for (const std::string& kind : {bent.truth.train, bent.truth.validate}) {
            EXPECT_FALSE(blind::has_one_level(kind));
            EXPECT_NE(kind, "prbs");
        }
    }
}

// The largest power of ten of which all values are multiples.
double decimal_of(const std::vector<double>& values) {
    for (int digits = -3; digits < 12; ++digits) {
        const double step = std::pow(10.0, -digits);
        if (std::all_of(values.begin(), values.end(), [&](double value) {
                return std::fabs(value - step * std::round(value / step)) < 1e-6 * step + 1e-12 * std::fabs(value);
            })) {
            return step;
        }
    }
    return 0.0;
}

TEST(OpenRecords, AreWhatTheReadmeSays) {
    std::set<std::size_t> trained, judged;
    std::size_t lifted = 0;
    std::size_t in_motion = 0;
    std::size_t own_clocks = 0;
    for (std::size_t number = 1; number <= 12; ++number) {
        const blind::Family* family = blind::families()[number % 3];
        const auto made = blind::make_open_case({family, {Class::none, {}, {}, false}}, 51, number);
        const auto& truth = made.truth;
        trained.insert(truth.train.size());
        judged.insert(truth.validate.size());
        ASSERT_EQ(made.records.size(), truth.train.size() + truth.validate.size());
        std::set<std::string> kinds;
        for (const std::string& kind : truth.train) {
            EXPECT_NE(kind, "step");  // nothing would tell how it comes down
            kinds.insert(kind);
        }
        for (const std::string& kind : truth.validate) {
            EXPECT_NE(kind, "rising");
            kinds.insert(kind);
        }
        EXPECT_EQ(kinds.size(), made.records.size()) << "each record has an excitation of its own";
        EXPECT_FALSE(kinds.contains("step") && kinds.contains("on_off"));
        EXPECT_GE(truth.gap_base, truth.noise_floor);
        EXPECT_EQ(truth.left_in_training, 0.0);
        std::vector<double> all;
        for (std::size_t i = 0; i < made.records.size(); ++i) {
            const bool in_training = i < truth.train.size();
            const std::size_t count = in_training ? truth.train.size() : truth.validate.size();
            const std::size_t own = in_training ? i : i - truth.train.size();
            const std::string name = in_training ? "train" : "validate";
            EXPECT_EQ(made.records[i].first,
                      count == 1 ? name + ".csv" : name + "-" + std::to_string(own + 1) + ".csv");
            drive::Log log = drive::parse_log(made.records[i].second, made.records[i].first);
            // Rounded by half the noise at most, and not to nothing.
            const double decimal = decimal_of(log.output);
            EXPECT_LE(decimal, 0.5 * truth.noise * 1.001);
            EXPECT_GE(decimal, 0.002 * truth.noise * 0.999);
            if (in_training) {
                all.insert(all.end(), log.output.begin(), log.output.end());
            }
            const drive::StampReport stamps = drive::order_stamps(log);
            const auto rows = static_cast<double>(log.time_s.size());
            EXPECT_EQ(stamps.backward, 0U);
            EXPECT_LT(static_cast<double>(stamps.repeated), 0.02 * rows);
            EXPECT_LT(static_cast<double>(stamps.missing), 0.05 * rows);
            EXPECT_GT(rows, 700.0);
            EXPECT_LT(rows, 5600.0);
            lifted += lowest(log.input) > 0.0 ? 1 : 0;
            EXPECT_TRUE(family != &blind::mechanical_family() || lowest(log.input) == 0.0 || log.input.front() != 0.0);
            in_motion += log.input.front() != 0.0 || log.time_s.front() > 0.0 ? 1 : 0;
            own_clocks += log.time_s.front() == 0.0 ? 1 : 0;
        }
        const double share = truth.noise / blind::deviation_of(all);
        EXPECT_GT(share, 0.00095);
        EXPECT_LT(share, 0.0051);
    }
    EXPECT_THAT(trained, testing::ElementsAre(1U, 2U));
    EXPECT_THAT(judged, testing::ElementsAre(1U, 2U));
    EXPECT_GE(lifted, 3U);
    EXPECT_GE(in_motion, 3U);
    EXPECT_GE(own_clocks, 3U);
}

// The numbers of cases whose first share of a stream lies so. \param seed  of a set of cases
std::vector<std::size_t> numbers_with(std::uint64_t seed, std::uint64_t stream, double from, double to,
                                      std::size_t count) {
    std::vector<std::size_t> numbers;
    for (std::size_t number = 1; numbers.size() < count; ++number) {
        const double share = stand::Chance(seed * 1000003U + number, stream).share();
        if (from <= share && share < to) {
            numbers.push_back(number);
        }
    }
    return numbers;
}

// Three plants in ten are the stand itself, and of the linear ones half are of fractional order: those whose share, the
// first of their plant's stream, is at most 0.3, and above 0.65.
TEST(BlindRecords, ShareTheirPlants) {
    const auto plant = [](std::size_t number) {
        return blind::make_case({Class::none, {}, {}, false}, 47, number).truth.plant;
    };
    const std::uint64_t plants = 1;
    for (const std::size_t number : numbers_with(47, plants, 0.297, 0.3, 2)) {
        EXPECT_EQ(plant(number), "stand") << number;
    }
    for (const std::size_t number : numbers_with(47, plants, 0.3, 0.303, 2)) {
        EXPECT_EQ(plant(number), "whole") << number;
    }
    for (const std::size_t number : numbers_with(47, plants, 0.6435, 0.65, 2)) {
        EXPECT_EQ(plant(number), "whole") << number;
    }
    for (const std::size_t number : numbers_with(47, plants, 0.65, 0.6565, 2)) {
        EXPECT_EQ(plant(number), "fractional") << number;
    }
}

// Noise of 0.2 to 1 % of the deviation, evenly in its logarithm; half of it white, the rest with a memory. Without a
// model 0.1 to 0.5 %.
TEST(BlindRecords, DrawTheirNoiseEvenlyInItsLogarithm) {
    std::set<bool> coloured;
    for (std::size_t number = 1; number <= 4; ++number) {
        const auto made = blind::make_case({Class::none, {}, {}, false}, 48, number);
        stand::Chance effects(48U * 1000003U + number, 2);
        const bool has_memory = effects.share() < 0.5;
        EXPECT_EQ(made.truth.coloured, has_memory) << number;
        coloured.insert(has_memory);
        (void)(has_memory ? effects.share() : 0.0);  // how much of it
        const double share = 0.002 * std::pow(5.0, effects.share());
        const double deviation = blind::deviation_of(drive::parse_log(made.train, "t").output);
        EXPECT_NEAR(made.truth.noise / deviation / share, 1.0, 2e-3) << number;

        const blind::Family* family = blind::families()[number % 3];
        const auto open = blind::make_open_case({family, {Class::none, {}, {}, false}}, 48, number);
        stand::Chance faults(48U * 1000003U + number, 102);
        const double open_share = 0.001 * std::pow(5.0, faults.share());
        EXPECT_EQ(open.truth.coloured, faults.share() < 0.5) << number;
        std::vector<double> readings;
        for (std::size_t i = 0; i < open.truth.train.size(); ++i) {
            const auto log = drive::parse_log(open.records[i].second, "t");
            readings.insert(readings.end(), log.output.begin(), log.output.end());
        }
        EXPECT_NEAR(open.truth.noise / blind::deviation_of(readings) / open_share, 1.0, 6e-3) << number;
    }
    EXPECT_EQ(coloured.size(), 2U);
}

}  // namespace
