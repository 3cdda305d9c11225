// How large things are in records: each of what bounds and starts are taken from, by hand; what counts; what is
// refused.
#include "gap/drive/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/failure.hpp"
#include "gap/drive/moments.hpp"
#include "gap/drive/plausible.hpp"
#include "gap/drive/start.hpp"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

gap::Record record_of(const std::vector<double>& input, const std::vector<double>& output, double interval_s = 0.5) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = interval_s;
    record.input = input;
    record.output = output;
    for (std::size_t i = 0; i < output.size(); ++i) {
        record.time_s.push_back(100.0 + interval_s * static_cast<double>(i));
    }
    return record;
}

drive::Model model_of(std::vector<drive::Term> denominator, double gain = 1.0) {
    drive::Model model;
    model.gain = gain;
    model.denominator = std::move(denominator);
    return model;
}

// 20 s.
gap::Record usual() {
    gap::Record record = record_of(std::vector<double>(41, 0.0), std::vector<double>(41, 0.0));
    record.input[3] = 2.0;
    record.input[9] = -0.5;
    record.output[4] = -1.0;
    record.output[20] = 4.0;
    return record;
}

TEST(GapScales, AreTheExtremesOfAllRecords) {
    gap::Record other = record_of(std::vector<double>(61, 0.1), std::vector<double>(61, 0.5));
    other.output[7] = -3.0;
    other.input[5] = 2.5;
    gap::Audit found;
    found.quantum = 0.01;
    found.held_share = 0.2;
    found.levels = 7;
    const gap::Scales scales = gap::scales_of(model_of({{0.8, 1.5}, {2.0, 0.0}}, -3.0), {usual(), other}, found);
    EXPECT_EQ(scales.input_max, 2.5);
    EXPECT_EQ(scales.output_low, -3.0);
    EXPECT_EQ(scales.output_high, 4.0);
    EXPECT_EQ(scales.output_span, 7.0);
    EXPECT_EQ(scales.output_max, 4.0);
    EXPECT_EQ(scales.length_s, 30.0);
    EXPECT_EQ(scales.interval_s, 0.5);
    EXPECT_EQ(scales.force, 7.5);
    EXPECT_EQ(scales.quantum, 0.01);
    EXPECT_EQ(scales.held_share, 0.2);
    EXPECT_EQ(scales.input_levels, 7U);
    EXPECT_TRUE(scales.driven);
    EXPECT_TRUE(scales.steady);
    EXPECT_EQ(scales.further_max, 0.0);
    EXPECT_EQ(scales.turn, 0.0);
    // The largest reading from 0 may be the lowest.
    other.output[7] = -6.0;
    EXPECT_EQ(gap::scales_of(model_of({{0.8, 1.5}, {2.0, 0.0}}), {usual(), other}, found).output_max, 6.0);
}

TEST(GapScales, HaveTheMeanTimeOfTheModelsTerms) {
    const auto tc = [](const drive::Model& model) { return gap::scales_of(model, {usual()}, {}).time_constant_s; };
    EXPECT_NEAR(tc(model_of({{4.0, 1.0}, {2.0, 0.0}})), 2.0, 1e-12);
    // (6/2)^(1/1), (32/2)^(1/2): the mean of 3 and 4.
    EXPECT_NEAR(tc(model_of({{32.0, 2.0}, {6.0, 1.0}, {2.0, 0.0}})), 3.5, 1e-12);
    // Neither below two intervals nor above three tenths of the record; a tenth of it where nothing rests.
    EXPECT_NEAR(tc(model_of({{0.1, 1.0}, {1.0, 0.0}})), 1.0, 1e-12);
    EXPECT_NEAR(tc(model_of({{500.0, 1.0}, {1.0, 0.0}})), 6.0, 1e-12);
    EXPECT_NEAR(tc(model_of({{3.0, 2.0}, {1.0, 1.0}})), 2.0, 1e-12);
    const gap::Scales scales = gap::scales_of(model_of({{4.0, 1.0}, {2.0, 0.0}}), {usual()}, {});
    EXPECT_NEAR(scales.speed_max, 5.0 / 2.0, 1e-12);
}

TEST(GapScales, KnowWhatThePlantIs) {
    const auto of = [](std::vector<drive::Term> denominator) {
        return gap::scales_of(model_of(std::move(denominator)), {usual()}, {});
    };
    EXPECT_EQ(of({{1.0, 2.0}, {1.0, 1.0}, {1.0, 0.0}}).orders, 2U);
    EXPECT_EQ(of({{1.0, 1.0}, {1.0, 0.0}}).orders, 1U);
    EXPECT_EQ(of({{1.0, 2.0}, {1.0, 1.0}}).orders, 2U);
    EXPECT_FALSE(of({{1.0, 2.0}, {1.0, 1.0}}).steady);
    // A speed has an order of 1.2 at most.
    EXPECT_TRUE(of({{1.0, 1.2}, {1.0, 0.0}}).maybe_speed);
    EXPECT_FALSE(of({{1.0, 1.21}, {1.0, 0.0}}).maybe_speed);
    // 1 + 2 d s + s^2 swings where d < 1, and by more than equal lags do.
    EXPECT_TRUE(of({{1.0, 2.0}, {1.9, 1.0}, {1.0, 0.0}}).swings);
    EXPECT_FALSE(of({{1.0, 2.0}, {1.985, 1.0}, {1.0, 0.0}}).swings);
    EXPECT_TRUE(of({{1.0, 2.0}, {1.975, 1.0}, {1.0, 0.0}}).swings);
    EXPECT_FALSE(of({{1.0, 1.0}, {1.0, 0.0}}).swings);
}

// Two signs are two where the smaller one is more than a twentieth.
TEST(GapScales, KnowTheSignsOfTheInput) {
    gap::Record record = usual();
    const auto two = [&](double below) {
        record.input[9] = below;
        return gap::scales_of(model_of({{1.0, 1.0}, {1.0, 0.0}}), {record}, {}).two_signs;
    };
    EXPECT_TRUE(two(-0.5));
    EXPECT_TRUE(two(-0.101));
    EXPECT_FALSE(two(-0.1));
    EXPECT_TRUE(two(-30.0));
    EXPECT_FALSE(two(-50.0));
}

TEST(GapScales, OfAFreeMotionHaveTheForceThatMovesIt) {
    gap::Record record = usual();
    std::fill(record.input.begin(), record.input.end(), 0.0);
    const gap::Scales back = gap::scales_of(model_of({{0.5, 2.0}, {20.0, 0.0}}, 7.0), {record}, {});
    EXPECT_FALSE(back.driven);
    EXPECT_EQ(back.input_max, 1.0);
    EXPECT_NEAR(back.force, 20.0 * 4.0, 1e-12);
    // Inertia over the time in which most happens, here a tenth of the record, squared.
    const gap::Scales on = gap::scales_of(model_of({{0.5, 2.0}, {3.0, 1.0}}), {record}, {});
    EXPECT_NEAR(on.force, 0.5 * 5.0 / 4.0, 1e-12);
}

TEST(GapScales, HaveADeployedStepWhereASimulationOfSomeStepsRan) {
    drive::Model model = model_of({{1.0, 1.5}, {1.0, 0.0}});
    const auto step = [&] { return gap::scales_of(model, {usual()}, {}).deployed_step_s; };
    EXPECT_EQ(step(), 0.5);  // the log's interval
    model.sample_time_s = 0.01;
    EXPECT_EQ(step(), 0.01);
    model.sample_time_s = 20.0 / 12000.0;
    EXPECT_EQ(step(), 20.0 / 12000.0);
    model.sample_time_s = 20.0 / 12001.0;
    EXPECT_EQ(step(), 0.0);
    model = model_of({{1.0, 2.0}, {1.0, 1.0}, {1.0, 0.0}});  // whole orders have no memory to lose
    EXPECT_EQ(step(), 0.0);
}

TEST(GapScales, OfASecondInputNeedItInEveryRecord) {
    gap::Record with = usual();
    with.more_inputs = {std::vector<double>(41, 0.25), std::vector<double>(41, 9.0)};
    with.more_inputs[0][7] = -1.5;
    const drive::Model model = model_of({{1.0, 1.0}, {1.0, 0.0}});
    EXPECT_EQ(gap::scales_of(model, {with, with}, {}).further_max, 1.5);
    EXPECT_EQ(gap::scales_of(model, {with, usual()}, {}).further_max, 0.0);
}

// A turn is a jump by more than six tenths of the span, calm on both sides: what it moves there is taken off.
TEST(GapScales, HaveTheTurnThatReadingsJumpBy) {
    const auto turn_of = [](double jump, double before, double after) {
        std::vector<double> output;
        double at = 0.0;
        for (int i = 0; i < 41; ++i) {
            output.push_back(at);
            at += i == 20 ? -jump : i < 20 ? before : after;
        }
        return gap::scales_of(model_of({{1.0, 1.0}, {1.0, 0.0}}), {record_of(std::vector<double>(41, 1.0), output)}, {})
            .turn;
    };
    EXPECT_NEAR(turn_of(9.5, 0.5, 0.5), 10.0, 1e-9);
    EXPECT_NEAR(turn_of(9.8, 0.3, 0.1), 10.0, 1e-9);
    EXPECT_EQ(turn_of(5.0, 0.5, 0.5), 0.0);  // half the span
    // Of several the median: 10, 8, 7, 8.5 and 9.5.
    std::vector<double> several;
    for (const double held : {0.0, 10.0, 2.0, 9.0, 0.5, 10.0}) {
        several.insert(several.end(), 7, held);
    }
    several.resize(41);
    EXPECT_EQ(
        gap::scales_of(model_of({{1.0, 1.0}, {1.0, 0.0}}), {record_of(std::vector<double>(41, 1.0), several)}, {}).turn,
        8.5);
    // Of what is not calm none.
    std::vector<double> spike(41, 0.0);
    spike[20] = 10.0;
    EXPECT_EQ(
        gap::scales_of(model_of({{1.0, 1.0}, {1.0, 0.0}}), {record_of(std::vector<double>(41, 1.0), spike)}, {}).turn,
        0.0);
}

// --- What counts.

TEST(GapCounts, AreAllOrEveryThirdTenthKeptAside) {
    const gap::Record record = record_of(std::vector<double>(41, 0.0), std::vector<double>(41, 0.0));
    EXPECT_THAT(gap::all_count({record, record}), ElementsAre(std::vector<char>(41, 1), std::vector<char>(41, 1)));
    const auto aside = gap::part_counts({record}, {}, true).front();
    const auto rest = gap::part_counts({record}, {}, false).front();
    for (std::size_t i = 0; i < 41; ++i) {
        const std::size_t tenth = i / 4;  // 40 intervals; the last stamp is a tenth of its own
        EXPECT_EQ(aside[i], tenth == 2 || tenth == 5 || tenth == 8) << i;
        EXPECT_EQ(aside[i] + rest[i], 1) << i;
    }
    // However finely a record is read, each tenth begins where the last one ends, to a sample.
    const gap::Record fine = record_of(std::vector<double>(4001, 0.0), std::vector<double>(4001, 0.0));
    const auto of_fine = gap::part_counts({fine}, {}, true).front();
    for (std::size_t i = 0; i < 4000; ++i) {
        if (i % 400 != 0) {
            ASSERT_EQ(of_fine[i], i / 400 % 3 == 2) << i;
        }
    }
    const auto behind = gap::part_counts({record}, 110.0, true).front();
    EXPECT_EQ(behind[19], 0);
    EXPECT_EQ(behind[20], 1);  // at the split
    EXPECT_EQ(gap::part_counts({record}, 110.0, false).front()[19], 1);
    EXPECT_EQ(gap::part_counts({record}, 110.0, false).front()[20], 0);
}

gap::Study study_of(const std::vector<gap::Record>& records, const drive::Model& model) {
    gap::Study study{
        {gap::form_of(model), false}, gap::scales_of(model, records, {}), {}, gap::all_count(records), 0.01, 0.004, 0};
    for (const gap::Record& record : records) {
        study.courses.emplace_back(record, 1);
    }
    return study;
}

TEST(GapCounts, AreWhatDeviationsAreOf) {
    gap::Record record = usual();
    EXPECT_NEAR(gap::deviation_of({record}), std::sqrt((1.0 + 16.0) / 41.0 - 9.0 / (41.0 * 41.0)), 1e-12);
    const std::vector<gap::Record> records = {record};
    gap::Study study = study_of(records, model_of({{4.0, 1.0}, {2.0, 0.0}}));
    EXPECT_NEAR(gap::output_deviation(study), gap::deviation_of(records), 1e-12);
    std::vector<std::vector<double>> values = {std::vector<double>(41, 0.0)};
    values[0][4] = 3.0;
    values[0][5] = 4.0;
    EXPECT_NEAR(gap::rms_of(study, values), 5.0 / std::sqrt(41.0), 1e-12);
    study.counts[0].assign(41, 0);
    EXPECT_EQ(gap::rms_of(study, values), 0.0);
    study.counts[0][4] = study.counts[0][20] = 1;
    EXPECT_NEAR(gap::rms_of(study, values), 3.0 / std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(gap::output_deviation(study), 2.5, 1e-12);
    // Over what differs from sample to sample, a quantum's noise at least.
    EXPECT_NEAR(gap::over_noise(study, 0.05), 5.0, 1e-12);
    study.least_deviation = 0.02;
    EXPECT_NEAR(gap::over_noise(study, 0.05), 2.5, 1e-12);
    EXPECT_FALSE(gap::is_slow(study, 0.02 * 8.0));
    EXPECT_TRUE(gap::is_slow(study, 0.02 * 8.01));
}

TEST(GapCounts, TellFreeMotionsFromDrivenOnes) {
    gap::Record still = usual();
    std::fill(still.input.begin(), still.input.end(), 0.0);
    EXPECT_FALSE(gap::is_driven({still, still}));
    EXPECT_TRUE(gap::is_driven({still, usual()}));
}

// --- What is refused.

std::string refusal_of(const gap::Record& record, const drive::Model& model, bool refit = false) {
    const std::vector<gap::Record> records = {record};
    gap::Study study = study_of(records, model);
    study.base.refit = refit;
    try {
        gap::check_plausible(study);
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "";
}

gap::Record answer_of(const drive::Model& model, double times, double interval_s = 0.5) {
    std::vector<double> input(41, 1.0);
    std::fill(input.begin() + 20, input.end(), 0.25);
    gap::Record record = record_of(input, input, interval_s);
    gap::Scenario plain;
    plain.model = model;
    record.output = gap::simulate(plain, gap::Course(record, 4));
    for (double& z : record.output) {
        z = 5.0 + times * z;
    }
    return record;
}

TEST(Plausible, AreRecordsInTheModelsUnits) {
    const drive::Model model = model_of({{4.0, 1.0}, {2.0, 0.0}});
    for (const double times : {1.0, -1.0, 49.0, 0.0205}) {
        EXPECT_EQ(refusal_of(answer_of(model, times), model), "") << times;
    }
    for (const double times : {52.0, 0.0195, -100.0}) {
        EXPECT_THAT(refusal_of(answer_of(model, times), model), HasSubstr("expected the model's units")) << times;
    }
    EXPECT_THAT(refusal_of(answer_of(model, 100.0), model), HasSubstr("made: its output moves 100 times as far"));
    EXPECT_EQ(refusal_of(answer_of(model, 100.0), model, true), "");  // a fitted base has any gain
    // What does not look like the model at all is another gap, whatever its size.
    gap::Record other = answer_of(model, 100.0);
    for (std::size_t i = 0; i < other.size(); ++i) {
        other.output[i] = i % 2 == 0 ? 100.0 : -100.0;
    }
    EXPECT_EQ(refusal_of(other, model), "");
}

// Nor where the model moves so little that its square is rounded to nothing.
TEST(Plausible, AreNoRecordsBesideAModelThatHardlyMoves) {
    const std::vector<drive::Term> denominator{{4.0, 1.0}, {2.0, 0.0}};
    const gap::Record record = answer_of(model_of(denominator), 1.0);
    for (const double gain : {1e-3, 1e-150, 1e-170}) {
        EXPECT_THAT(refusal_of(record, model_of(denominator, gain)), HasSubstr("expected the model's units")) << gain;
    }
}

// A fiftieth and fifty times as far are the model's units still. Of numbers about these, as they are rounded, some are
// that ratio.
TEST(Plausible, AreRecordsOfAFiftiethAndOfFiftyTimes) {
    const drive::Model model = model_of({{4.0, 1.0}, {2.0, 0.0}});
    gap::Record record = answer_of(model, 1.0);
    gap::Scenario plain;
    plain.model = gap::model_of(gap::form_of(model));
    const std::vector<double> simulated = gap::simulate(plain, gap::Course(record, 1));
    for (const double bound : {0.02, 50.0}) {
        const auto is_met = [&](double times, double level) {
            for (std::size_t i = 0; i < simulated.size(); ++i) {
                record.output[i] = level + times * simulated[i];
            }
            const gap::Moments sums = gap::moments_of(simulated, record.output);
            return std::sqrt(sums.yy / sums.xx) == bound;
        };
        int met = 0;
        for (int level = 0; level < 20 && met == 0; ++level) {
            double times = bound * (1.0 - 1e-14);
            for (int step = 0; step < 100 && met == 0; ++step) {
                times = std::nextafter(times, 100.0);
                met += is_met(times, 0.125 * level) ? 1 : 0;
            }
        }
        ASSERT_EQ(met, 1) << bound;
        EXPECT_EQ(refusal_of(record, model), "") << bound;
    }
}

TEST(Plausible, AreStampsInSeconds) {
    // Slowest time 2 s. The log lasts 40 intervals, and has to last a tenth of that.
    const drive::Model model = model_of({{4.0, 1.0}, {2.0, 0.0}});
    EXPECT_EQ(refusal_of(answer_of(model, 1.0, 0.00501), model), "");
    EXPECT_THAT(refusal_of(answer_of(model, 1.0, 0.00499), model), HasSubstr("but the model takes 2 s to move"));
    EXPECT_EQ(refusal_of(answer_of(model, 1.0, 9.9), model), "");
    EXPECT_THAT(refusal_of(answer_of(model, 1.0, 10.1), model), HasSubstr("but the model is done after 2 s"));
    // The slowest of several terms, each over what restores: (6 / 1.5)^(1 / 0.5) of these; above 1, and below.
    EXPECT_THAT(refusal_of(answer_of(model, 1.0, 0.03), model_of({{2.25, 2.0}, {6.0, 0.5}, {1.5, 0.0}})),
                HasSubstr("but the model takes 16 s to move"));
    EXPECT_THAT(refusal_of(answer_of(model, 1.0, 0.0001), model_of({{0.5, 2.0}, {0.1, 1.0}, {8.0, 0.0}})),
                HasSubstr("but the model takes 0.25 s to move"));
    drive::Model late = model;
    late.delay_s = 1.0;
    EXPECT_EQ(refusal_of(answer_of(late, 1.0, 14.9), late), "");
    EXPECT_THAT(refusal_of(answer_of(late, 1.0, 15.1), late), HasSubstr("is done after 3 s"));
    late.delay_s = 19.9;
    EXPECT_EQ(refusal_of(answer_of(model, 1.0), late), "");
    late.delay_s = 20.0;
    EXPECT_THAT(refusal_of(answer_of(model, 1.0), late),
                HasSubstr("a log longer than the model's dead time of 20 s, found one of 20 s"));
}

TEST(Plausible, AreModelsThatStayAndMove) {
    EXPECT_THAT(refusal_of(answer_of(model_of({{4.0, 1.0}, {2.0, 0.0}}), 1.0), model_of({{0.3, 1.0}, {-1.0, 0.0}})),
                HasSubstr("the model runs away on its input"));
    gap::Record still = usual();
    std::fill(still.input.begin(), still.input.end(), 0.0);
    const drive::Model model = model_of({{4.0, 1.0}, {2.0, 0.0}});
    EXPECT_THAT(refusal_of(still, model), HasSubstr("the input is 0 throughout"));
    still.simulated = still.output;  // the user's own simulator may have begun elsewhere
    EXPECT_EQ(refusal_of(still, model), "");
}

}  // namespace
