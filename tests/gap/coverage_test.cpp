// What validation has and training lacks, on records of which it is known; and the words of what to measure next.
#include "gap/drive/coverage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "gap/drive/experiment.hpp"
#include "stand_case.hpp"

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

using Function = std::function<double(double)>;

gap::Record record_of(double length_s, const Function& input, const Function& output, unsigned seed = 1) {
    constexpr double interval_s = 0.02;
    gap::Record record;
    record.name = "record";
    record.usual_interval_s = interval_s;
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 0.002);
    for (double t = 0.0; t < length_s; t += interval_s) {
        record.time_s.push_back(t);
        record.input.push_back(input(t));
        record.output.push_back(output(t) + noise(engine));
    }
    return record;
}

double held(double) { return 1.0; }
double wave(double hz, double t) { return std::sin(2.0 * std::numbers::pi * hz * t); }

TEST(Coverage, FindsNothingWhereValidationIsLikeTraining) {
    const auto output = [](double t) { return wave(0.1, t) + 0.2 * wave(1.0, t); };
    const auto input = [](double t) { return t < 10.0 ? 0.3 : 0.8; };
    EXPECT_THAT(gap::extrapolated({record_of(20.0, input, output, 1)}, {record_of(20.0, input, output, 2)}), IsEmpty());
}

TEST(Coverage, TellsADirectionThatTrainingNeverWent) {
    const auto heats = [](double t) { return 1.0 - std::exp(-t / 5.0); };
    const auto cools = [](double t) { return std::exp(-t / 5.0); };
    EXPECT_THAT(gap::extrapolated({record_of(20.0, held, heats)}, {record_of(20.0, held, cools)}),
                ElementsAre("falling output"));
    EXPECT_THAT(gap::extrapolated({record_of(20.0, held, cools)}, {record_of(20.0, held, heats)}),
                ElementsAre("rising output"));
}

TEST(Coverage, TellsLevelsBeyondThoseOfTrainingAndBetweenThem) {
    const auto output = [](double t) { return wave(0.1, t); };
    const auto between = [](double from, double to) {
        return [=](double t) { return std::fmod(t, 4.0) < 2.0 ? from : to; };
    };
    const auto asked = [&](const Function& known, const Function& wanted) {
        return gap::extrapolated({record_of(20.0, known, output, 1)}, {record_of(20.0, wanted, output, 2)});
    };
    EXPECT_THAT(asked(between(0.2, 0.6), between(0.2, 0.9)), ElementsAre("input above 0.6"));
    EXPECT_THAT(asked(between(0.2, 0.6), between(-0.3, 0.6)), ElementsAre("input below 0.2"));
    EXPECT_THAT(asked(between(0.0, 1.0), between(0.4, 1.0)), ElementsAre("input between 0 and 1"));
    EXPECT_THAT(asked(between(0.0, 1.0), between(0.0, 1.02)), IsEmpty());
    const auto far = [](double t) { return 1.6 * wave(0.1, t); };
    const auto of_output = gap::extrapolated({record_of(20.0, held, output, 1)}, {record_of(20.0, held, far, 2)});
    EXPECT_THAT(of_output, ElementsAre(StartsWith("output above 1"), StartsWith("output below -1")));
}

TEST(Coverage, TellsFrequenciesThatTrainingLacks) {
    const auto slow = [](double t) { return wave(0.1, t); };
    const auto fast = [](double t) { return 0.5 * wave(0.1, t) + 0.5 * wave(3.0, t); };
    const auto faster = gap::extrapolated({record_of(20.0, held, slow)}, {record_of(20.0, held, fast)});
    ASSERT_THAT(faster, ElementsAre(StartsWith("faster than ")));
    const double hz = std::stod(faster.front().substr(12));
    EXPECT_GT(hz, 0.3);
    EXPECT_LT(hz, 3.0);
    const auto quick = [](double t) { return wave(3.0, t); };
    EXPECT_THAT(gap::extrapolated({record_of(20.0, held, quick)}, {record_of(20.0, held, fast)}),
                ElementsAre(StartsWith("slower than ")));
}

TEST(Coverage, CutsOutWhatCounts) {
    const gap::Record record = record_of(2.0, held, held);
    std::vector<char> counts(100, 1);
    counts[40] = 0;
    counts[90] = 0;
    const std::vector<gap::Record> stretches = gap::counted_stretches({record}, {counts});
    ASSERT_EQ(stretches.size(), 2U);  // the last nine are too few
    EXPECT_EQ(stretches[0].size(), 40U);
    EXPECT_EQ(stretches[1].size(), 49U);
    EXPECT_EQ(stretches[1].time_s.front(), record.time_s[41]);
}

TEST(NextExperiment, OfAnAttributionNarrowsWhatWasNamed) {
    const gap::Answer answer = gap_test::ask({{"input_dead_zone.width", 0.015}});
    EXPECT_THAT(answer.next_experiment, HasSubstr("input_dead_zone.width"));
    EXPECT_THAT(answer.next_experiment, HasSubstr("times"));
    const double factor = std::stod(answer.next_experiment.substr(answer.next_experiment.find(": ") + 2));
    EXPECT_GT(factor, 1.0) << answer.next_experiment;
}

TEST(NextExperiment, OfAnUnknownIsToTrainOnWhatWasExtrapolated) {
    // A staircase up to 0.05 to learn from, twice as far to judge by, and a stop between that is off the list.
    const gap::Answer answer = gap_test::ask({{"end_stop.limit", 0.5}}, {.duty = 0.05, .seed = 71},
                                             {.experiment = "prbs", .duty = 0.1, .low_duty = 0.02, .seed = 72},
                                             {"end_stop", "sensor_saturation", "input_saturation"});
    EXPECT_THAT(answer.extrapolated, Contains(StartsWith("input above 0.05")));
    ASSERT_EQ(answer.decision.outcome, gap::Outcome::unknown) << answer.next_experiment;
    EXPECT_THAT(answer.next_experiment, StartsWith("train on "));
    EXPECT_THAT(answer.next_experiment, HasSubstr("input above 0.05"));
}

}  // namespace
