// What a question is prepared as: which effects can be there, what is fitted and what judges, and how fine.
#include "gap/drive/question.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/start.hpp"

namespace {

using testing::Contains;
using testing::Not;

// 40 s at 10 Hz of a lag of 1 s, between 0 and about 2.
gap::Record record_of(double from = 0.0, int last = 400) {
    gap::Record record;
    record.name = "lag";
    record.usual_interval_s = 0.1;
    double y = 0.0;
    for (int i = 0; i <= last; ++i) {
        record.time_s.push_back(0.1 * i);
        record.input.push_back((i / 50) % 2 == 0 ? from : 1.0);
        record.output.push_back(y + 1e-3 * std::sin(37.0 * i * i));
        y += (2.0 * record.input.back() - y) * -std::expm1(-0.1);
    }
    return record;
}

gap::Question question_of(bool refit = false) {
    return {gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)),
            refit,
            {record_of()},
            {record_of(0.25)},
            {},
            gap::Metric::simulation,
            {},
            1};
}

std::vector<std::string> names_of(const std::vector<const gap::Effect*>& list) {
    std::vector<std::string> names;
    for (const gap::Effect* effect : list) {
        names.push_back(effect->name);
    }
    return names;
}

// A spring and a weight pull at a place, which the output of one driven lag need not be.
TEST(Prepared, ASpeedHidesSpringsWhereThereMayBeOne) {
    const auto hidden = [](const gap::Question& question) {
        return gap::speed_hides_effects(question, gap::prepare(question).study.scales);
    };
    gap::Question question = question_of(true);
    EXPECT_TRUE(hidden(question));
    question.domain = gap::Domain::electric;
    EXPECT_TRUE(hidden(question));
    question.domain = gap::Domain::thermal;
    EXPECT_FALSE(hidden(question));
    question.domain = gap::Domain::mechanical;
    EXPECT_TRUE(hidden(question));
    question.without = {"cubic_stiffness", "gravity_nonlinearity"};
    EXPECT_FALSE(hidden(question));
    question.without.clear();
    question.form = gap::form_of(drive::make_sopdt(2.0, 0.5, 0.0));
    EXPECT_FALSE(hidden(question));
}

// A validation in other units would judge a gap of units.
TEST(Prepared, RefusesRecordsOfOtherUnitsWhicheverTheyAre) {
    for (const bool trained : {true, false}) {
        gap::Question question = question_of();
        gap::Record& record = trained ? question.train[0] : question.validate[0];
        for (double& z : record.output) {
            z *= 100.0;
        }
        EXPECT_THROW((void)gap::prepare(question), glsum::Failure) << trained;
    }
}

TEST(Prepared, HasTheEffectsThatCanBeThere) {
    gap::Question question = question_of();
    question.without = {"backlash"};
    const auto given = names_of(gap::prepare(question).list);
    EXPECT_THAT(given, Not(Contains("backlash")));
    EXPECT_THAT(given, Not(Contains("second_input")));  // these records have none
    for (const char* effect : {"gain_error", "sensor_lag", "sensor_offset", "cogging", "coulomb_friction"}) {
        EXPECT_THAT(given, Contains(effect));
    }
    question.domain = gap::Domain::thermal;
    const auto thermal = names_of(gap::prepare(question).list);
    EXPECT_THAT(thermal, Not(Contains("cogging")));
    EXPECT_THAT(thermal, Contains("sensor_lag"));
    EXPECT_TRUE(gap::prepare(question).study.scales.drains);
    question.domain = gap::Domain::mechanical;
    EXPECT_FALSE(gap::prepare(question).study.scales.drains);
}

// A fitted base has its own errors already; a form that nobody gave takes up whatever is linear.
TEST(Prepared, LeavesOutWhatAFittedBaseHas) {
    gap::Question question = question_of(true);
    const auto fitted = names_of(gap::prepare(question).list);
    EXPECT_THAT(fitted, Not(Contains("gain_error")));
    EXPECT_THAT(fitted, Not(Contains("sensor_lag")));
    EXPECT_THAT(fitted, Contains("backlash"));
    question.given_form = true;
    const auto refitted = names_of(gap::prepare(question).list);
    EXPECT_THAT(refitted, Not(Contains("gain_error")));
    EXPECT_THAT(refitted, Contains("sensor_lag"));
}

// Without an input nothing on its way can be wrong.
TEST(Prepared, OfAFreeMotionHasNoEffectsOfTheInput) {
    gap::Question question = question_of(true);
    for (auto* records : {&question.train, &question.validate}) {
        for (std::size_t i = 0; i < records->front().size(); ++i) {
            records->front().input[i] = 0.0;
            records->front().output[i] =
                std::exp(-0.1 * static_cast<double>(i)) + 1e-3 * std::sin(37.0 * static_cast<double>(i * i));
        }
    }
    const auto free = names_of(gap::prepare(question).list);
    for (const char* effect : {"input_dead_zone", "rate_limit", "supply_sag", "variable_delay"}) {
        EXPECT_THAT(free, Not(Contains(effect)));
    }
    EXPECT_THAT(free, Contains("coulomb_friction"));
}

// From rest it would not move, and any steps would do: they are measured from where it is let go.
TEST(Prepared, OfAFreeSwingHasStepsThatFollowIt) {
    gap::Question question = question_of(true);
    drive::Model swing;
    swing.denominator = {{0.25, 2.0}, {0.02, 1.0}, {1.0, 0.0}};  // 2 rad/s, of 6 decays in the record
    question.form = gap::form_of(swing);
    for (auto* records : {&question.train, &question.validate}) {
        for (std::size_t i = 0; i < records->front().size(); ++i) {
            const double t = records->front().time_s[i];
            records->front().input[i] = 0.0;
            records->front().output[i] = std::exp(-0.04 * t) * (std::cos(2.0 * t) + 0.02 * std::sin(2.0 * t));
        }
    }
    const gap::Ground ground = gap::prepare(question);
    for (const gap::Study* study : {&ground.study, &ground.validation}) {
        EXPECT_LT(study->courses[0].grid().step_s, 0.1 / 4.0 + 1e-12);
    }
    const gap::Candidate found = gap::fit(ground.study, {}, ground.base, nullptr);
    EXPECT_NEAR(found.base[0].value, 0.25, 1e-4);
    EXPECT_NEAR(found.base[1].value, 0.02, 1e-4);
}

TEST(Prepared, JudgesByTheValidationOrByWhatIsKeptAside) {
    gap::Question question = question_of();
    {
        const gap::Ground ground = gap::prepare(question);
        EXPECT_FALSE(ground.same_records);
        EXPECT_EQ(&ground.study.courses[0].record(), &question.train[0]);
        EXPECT_EQ(&ground.validation.courses[0].record(), &question.validate[0]);
        EXPECT_EQ(ground.study.counts, gap::all_count(question.train));
        EXPECT_EQ(ground.validation.counts, gap::all_count(question.validate));
        // Where readings have no step a part in 5000 of their span.
        EXPECT_NEAR(ground.study.least_deviation, 2e-4 * ground.study.scales.output_span, 1e-12);
        EXPECT_EQ(ground.study.horizon, 0U);
    }
    question.validate.clear();
    {
        const gap::Ground ground = gap::prepare(question);
        EXPECT_TRUE(ground.same_records);
        EXPECT_EQ(ground.study.counts, gap::part_counts(question.train, {}, false));
        EXPECT_EQ(ground.validation.counts, gap::part_counts(question.train, {}, true));
    }
    question.split_s = 25.0;
    const gap::Ground ground = gap::prepare(question);
    EXPECT_EQ(ground.study.counts, gap::part_counts(question.train, 25.0, false));
    EXPECT_EQ(ground.validation.counts, gap::part_counts(question.train, 25.0, true));
}

// Beside what differs from sample to sample three tenths of it are not seen.
TEST(Prepared, HasStepsAsCoarseAsThreeTenthsOfTheNoise) {
    const gap::Question question = question_of();
    gap::Scenario plain;
    plain.model = gap::model_of(question.form);
    const auto nodes = [&](double allowed) { return gap::make_course(question.train[0], plain, allowed).grid().count; };
    double fine = 1e-9;
    double coarse = 1.0;
    ASSERT_GT(nodes(fine), nodes(coarse));
    while (coarse > 1.0001 * fine) {  // to where steps begin to do
        const double middle = std::sqrt(fine * coarse);
        (nodes(middle) > nodes(coarse) ? fine : coarse) = middle;
    }
    const auto made = [&](double times, std::size_t* count) {
        gap::Question noisy = question;
        for (auto* records : {&noisy.train, &noisy.validate}) {
            for (double& z : records->front().output) {
                z *= times;
            }
        }
        const gap::Ground ground = gap::prepare(noisy);
        *count = ground.study.courses[0].grid().count;
        return std::max(ground.study.noise, ground.study.least_deviation);
    };
    std::size_t count = 0;
    const double once = made(1.0, &count);
    for (const double allowed : {1.005 * coarse, 0.995 * fine}) {
        EXPECT_NEAR(0.3 * made(allowed / (0.3 * once), &count), allowed, 1e-6 * allowed);
        EXPECT_EQ(count, nodes(allowed)) << allowed << " of " << coarse;
    }
}

// While a base is looked for, what a sensor's end holds counts for nothing.
TEST(Prepared, LooksPastClippedReadings) {
    gap::Question question = question_of(true);
    std::vector<double>& read = question.train[0].output;
    std::fill_n(read.begin() + 120, 25, 2.5);
    const auto counted = [&] {
        const gap::Ground ground = gap::prepare(question);
        return std::count(ground.study.counts[0].begin(), ground.study.counts[0].end(), 1);
    };
    EXPECT_EQ(counted(), 401);
    question.past_ends = true;
    EXPECT_EQ(counted(), 376);
}

// A fiftieth of the record ahead, or as it is asked; one sample at least.
TEST(Prepared, PredictsSoFarAhead) {
    gap::Question question = question_of();
    question.metric = gap::Metric::prediction;
    EXPECT_EQ(gap::prepare(question).study.horizon, 8U);
    question.horizon_s = 2.55;
    EXPECT_EQ(gap::prepare(question).study.horizon, 25U);
    EXPECT_EQ(gap::prepare(question).validation.horizon, 25U);
    question.horizon_s = 0.01;
    EXPECT_EQ(gap::prepare(question).study.horizon, 1U);
    question.horizon_s.reset();
    question.train[0] = record_of(0.0, 5025);  // 502.5 s
    EXPECT_EQ(gap::prepare(question).study.horizon, 100U);
}

TEST(Prepared, OfSteppedReadingsIsNoFinerThanTheStep) {
    gap::Question question = question_of();
    for (auto* records : {&question.train, &question.validate}) {
        for (double& z : records->front().output) {
            z = 0.05 * std::round(z / 0.05);
        }
    }
    EXPECT_NEAR(gap::prepare(question).study.least_deviation, 0.29 * 0.05, 1e-9);
}

// The user's own simulation is the base to the last digit, whatever the model makes of it.
TEST(Prepared, TakesASimulationForTheBase) {
    gap::Question question = question_of();
    for (auto* records : {&question.train, &question.validate}) {
        gap::Record& record = records->front();
        for (std::size_t i = 0; i < record.size(); ++i) {
            record.simulated.push_back(record.output[i] + 0.01 * static_cast<double>(i % 7));
        }
    }
    const gap::Ground ground = gap::prepare(question);
    for (const gap::Study* study : {&ground.study, &ground.validation}) {
        const auto left = gap::residuals_of(*study, ground.base, 0);
        for (std::size_t i = 0; i < left.size(); ++i) {
            EXPECT_NEAR(left[i], -0.01 * static_cast<double>(i % 7), 1e-9) << i;
        }
    }
}

// First looks are cheaper, and read the same of the base.
TEST(Prepared, SketchesOnAThinnerGrid) {
    const gap::Question question = question_of();
    const gap::Ground ground = gap::prepare(question);
    EXPECT_LE(ground.sketch.courses[0].grid().count, ground.study.courses[0].grid().count);
    EXPECT_EQ(ground.sketch.courses[0].record().size(),
              question.train[0].size());  // beside a given model each sample counts
    const auto fine = gap::residuals_of(ground.study, ground.base, 0);
    const auto coarse = gap::residuals_of(ground.sketch, ground.base, 0);
    for (std::size_t i = 0; i < fine.size(); ++i) {
        EXPECT_NEAR(fine[i], coarse[i], 1e-9) << i;
    }
    EXPECT_EQ(ground.sketch.counts, ground.study.counts);
}

// Beside a form each first look has 1200 samples of a record, or ten to the form's time constant where those are fewer,
// and predicts as far ahead.
TEST(Prepared, SketchesAFormByFewerSamples) {
    const auto sketched = [](int samples, double time_constant_s) {
        gap::Question question = question_of(true);
        question.form = gap::form_of(drive::make_fopdt(2.0, time_constant_s, 0.0));
        question.train[0] = record_of(0.0, samples - 1);
        question.metric = gap::Metric::prediction;
        question.horizon_s = 2.55;
        const gap::Ground ground = gap::prepare(question);
        const std::size_t size = ground.sketch.courses[0].record().size();
        EXPECT_EQ(ground.sketch.horizon, size == static_cast<std::size_t>(samples) ? 25U : 12U);
        question.horizon_s = 0.1;
        EXPECT_EQ(gap::prepare(question).sketch.horizon, 1U);
        return size;
    };
    EXPECT_EQ(sketched(2399, 3.0), 2399U);
    EXPECT_EQ(sketched(2400, 3.0), 1200U);
    EXPECT_EQ(sketched(6000, 2.005), 3000U);
    EXPECT_EQ(sketched(6000, 1.995), 6000U);
}

}  // namespace
