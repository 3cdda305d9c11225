// What validation has and training lacks, on records of which it is known; and the words of what to measure next.
#include "gap/drive/coverage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "gap/drive/experiment.hpp"
#include "gap/drive/start.hpp"
#include "gap/drive/verdict.hpp"
#include "stand_case.hpp"

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
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
    // A reading that was lost is no fall; a third of the way down is one.
    gap::Record lost = record_of(20.0, held, heats);
    lost.output[300] = 0.0;
    EXPECT_THAT(gap::extrapolated({lost}, {record_of(20.0, held, cools)}), Contains("falling output"));
    const auto dips = [&](double t) { return heats(t) - (t > 15.0 ? 0.4 : 0.0); };
    EXPECT_THAT(gap::extrapolated({record_of(20.0, held, dips)}, {record_of(20.0, held, cools)}),
                Not(Contains("falling output")));
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

// Of every input that all records have, where what counts is cut out of them, too.
TEST(Coverage, TellsLevelsOfFurtherInputs) {
    const auto output = [](double t) { return wave(0.1, t); };
    const auto with = [&](double from, double to) {
        gap::Record record = record_of(20.0, held, output);
        record.more_inputs.emplace_back(record.size(), 5.0);
        record.more_inputs.emplace_back(record.size(), from);
        std::fill_n(record.more_inputs.back().begin(), record.size() / 2, to);
        return record;
    };
    EXPECT_THAT(gap::extrapolated({with(0.0, 50.0)}, {with(0.0, 80.0)}), ElementsAre("input 3 above 50"));
    EXPECT_THAT(gap::extrapolated({with(0.0, 50.0)}, {with(0.0, 10.0)}), ElementsAre("input 3 between 0 and 50"));
    EXPECT_THAT(gap::extrapolated({with(0.0, 50.0), record_of(20.0, held, output)}, {with(0.0, 80.0)}), IsEmpty());
    const gap::Record whole = with(0.0, 50.0);
    const std::size_t half = whole.size() / 2;
    std::vector<char> counts(whole.size(), 1);
    std::fill_n(counts.begin(), half, char{0});
    const gap::Record later = gap::counted_stretches({whole}, {counts}).front();
    ASSERT_EQ(later.more_inputs.size(), 2U);
    EXPECT_THAT(later.more_inputs[1], testing::AllOf(testing::SizeIs(later.size()), testing::Each(0.0)));
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
    const std::string before = "beside what there is: ";
    const std::size_t at = answer.next_experiment.find(before);
    ASSERT_NE(at, std::string::npos) << answer.next_experiment;
    const double factor = std::stod(answer.next_experiment.substr(at + before.size()));
    EXPECT_GT(factor, 1.2) << answer.next_experiment;
    // What the terminal says of it: the bits' levels, of which the dead zone takes most from the lower one.
    const std::string text = gap::to_text(answer);
    EXPECT_THAT(text, HasSubstr("where the residual (measured - simulated) of the base lies"));
    EXPECT_THAT(text, HasSubstr("  input at 0.1 "));
    EXPECT_THAT(text, testing::ContainsRegex("  output [-0-9.]+ to [0-9.]+ +[0-9.]+ %"));
    EXPECT_THAT(text, testing::ContainsRegex("variance explained: [0-9.]+ % by the simulation, (99.9|100.0) % by"));
    EXPECT_THAT(text, HasSubstr("next: " + answer.next_experiment));
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
    EXPECT_THAT(gap::to_text(answer), HasSubstr("extrapolated, as training has none of it: "));
    EXPECT_THAT(gap::to_json(answer), HasSubstr("\"extrapolated\": [\n    \"" + answer.extrapolated.front()));
}

// A pendulum that is let go: the angle per unit of its sine is known best from as far out as it has been, and nothing
// is put in.
TEST(NextExperiment, OfAFreeMotionIsToLetGoAgain) {
    drive::Model model;
    model.denominator = {{1.0, 2.0}, {0.3, 1.0}, {9.0, 0.0}};
    gap::Record record = record_of(
        12.0, [](double) { return 0.0; }, [](double t) { return std::exp(-0.15 * t) * std::cos(3.0 * t); });
    const gap::Effect& gravity = gap::effect_named("gravity_nonlinearity");
    const gap::Audit found = gap::audit({record});
    gap::Study study{{gap::form_of(model), true},
                     gap::scales_of(model, {record}, found),
                     {},
                     gap::all_count({record}),
                     found.noise,
                     1e-3,
                     0};
    study.courses.emplace_back(record, 1);
    gap::Candidate named;
    named.effects = {&gravity};
    named.base = gap::base_of(study);
    named.lasting = {gap::parameters_of(gravity, study.scales, 1)};
    named.own = {gap::state_of(study, record)};
    named.own[0][0].value = 0.0;  // where it comes to rest
    record.output = gap::simulate(gap::scenario_of(study, named, 0), study.courses[0]);
    gap::Whitener whitener;
    whitener.deviation = whitener.stationary_deviation = 0.002;
    const std::string text = gap::sharpen(study, named, whitener).text;
    EXPECT_THAT(text, StartsWith("let go from as far out as it has been"));
    EXPECT_THAT(text, HasSubstr("narrower for gravity_nonlinearity.angle_per_unit"));
}

}  // namespace
