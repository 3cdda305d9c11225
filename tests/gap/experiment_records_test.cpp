// Which records are simulated for the next experiment: between which inputs, how finely, how far the rig may go there.
// What they would tell is known of a drift, whose slope is the time itself.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gap/drive/experiment.hpp"
#include "gap/drive/start.hpp"

namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double deviation = 0.02;  // of the readings' noise
constexpr double length_s = 40.0;

// A lag of 1 s over 40 s, which went from 0 to 1, with a drift of the readings.
struct Drifting {
    std::vector<gap::Record> records;
    gap::Study study;
    gap::Candidate named;
    gap::Whitener whitener;
    int count;
    double interval_s;
    explicit Drifting(double gain = 1.0, double low = 0.0, double high = 1.0, int intervals = 400)
        : study{{gap::form_of(drive::make_fopdt(gain, 1.0, 0.0)), false}, {}, {}, {}, 0.01, 0.001, 0},
          count(intervals + 1),
          interval_s(length_s / intervals) {
        gap::Record& record = records.emplace_back();
        record.name = "drifts";
        record.usual_interval_s = interval_s;
        for (int i = 0; i < count; ++i) {
            record.time_s.push_back(interval_s * i);
            record.input.push_back(2 * i < count ? high : low);
            record.output.push_back(i == 100 ? 1.0 : 0.0);
        }
        study.counts = gap::all_count(records);
        study.courses.emplace_back(records[0], 1);
        study.scales = gap::scales_of(gap::model_of(study.base.form), records, {});
        named.effects = {&gap::effect_named("sensor_drift")};
        named.own.resize(1);
        named.lasting = {gap::parameters_of(*named.effects[0], study.scales, 0)};
        named.lasting[0][0].value = 0.0;
        records[0].output = gap::simulate(gap::scenario_of(study, named, 0), study.courses[0]);
        whitener.deviation = whitener.stationary_deviation = deviation;
    }
    [[nodiscard]] gap::Proposal sharper() const { return gap::sharpen(study, named, whitener); }
    // Beside what records tell: values that are spread evenly between -half and half have a variance of half^2 / 3.
    // A drift moves the readings by up to 0.8 of their span in the record, an offset by up to the span, which is 1.
    static double known_before(double half) { return 3.0 / (half * half); }
    static constexpr double most_drift = 0.8 / length_s;
    static constexpr double most_offset = 1.0;
    // What so many samples tell, of predictions over so many of them.
    static double told(int samples, double step_s, int horizon) {
        double squares = 0.0;
        for (int i = 0; i < samples; ++i) {
            squares += std::pow(step_s * std::min(i, horizon), 2);
        }
        return squares / (deviation * deviation);
    }
    static std::string words(double now, double added) {
        const double before = 1.96 / std::sqrt(now + known_before(most_drift));
        const double after = 1.96 / std::sqrt(now + added + known_before(most_drift));
        return fmt::format("{:.3g} times narrower for sensor_drift.per_s (within {:.2g} instead of {:.2g})",
                           before / after, after, before);
    }
};

// From the least input that there was, or 0, to the largest size of one; each as it is logged.
TEST(NextRecord, GoesBetweenTheInputsThatThereWere) {
    Drifting made(1.0, -0.5, 1.0);
    gap::Proposal proposal = made.sharper();
    EXPECT_THAT(proposal.text, StartsWith("three fifths, held for 120 s from -0.5 to 1, beside"));
    ASSERT_TRUE(proposal.record);
    for (const double u : proposal.record->input) {
        EXPECT_NEAR(u, -0.5 + 0.6 * 1.5, 1e-12);
    }
    made.study.base.idle_input = 2.0;
    proposal = made.sharper();
    EXPECT_THAT(proposal.text, StartsWith("three fifths, held for 120 s from 1.5 to 3, beside"));
    ASSERT_TRUE(proposal.record);
    for (const double u : proposal.record->input) {
        EXPECT_NEAR(u, 2.0 - 0.5 + 0.6 * 1.5, 1e-12);
    }
    // The least one is 0 where all are above.
    EXPECT_THAT(Drifting(1.0, 0.25, 1.0).sharper().text, StartsWith("three fifths, held for 120 s from 0 to 1,"));
}

// As the records are sampled, in 3000 samples at most.
TEST(NextRecord, HasThreeThousandSamplesAtMost) {
    const gap::Proposal usual = Drifting().sharper();
    ASSERT_TRUE(usual.record);
    EXPECT_NEAR(usual.record->time_s[1], 0.1, 1e-12);
    EXPECT_NEAR(usual.record->time_s.back(), 120.0, 0.15);
    const gap::Proposal fine = Drifting(1.0, 0.0, 1.0, 4000).sharper();
    ASSERT_TRUE(fine.record);
    EXPECT_NEAR(fine.record->time_s[1], 0.04, 1e-12);
    EXPECT_NEAR(fine.record->time_s.back(), 120.0, 0.09);
}

// Half of its span beyond where it has been, which is 0 to 1. Held at three fifths it goes least far.
TEST(NextRecord, StaysHalfASpanAboutWhereTheRigHasBeen) {
    for (const double gain : {2.495, -0.83}) {
        EXPECT_THAT(Drifting(gain).sharper().text, StartsWith("three fifths, held")) << gain;
    }
    for (const double gain : {2.505, -0.837}) {
        const gap::Proposal none = Drifting(gain).sharper();
        EXPECT_THAT(none.text, StartsWith("a record at other levels and speeds")) << gain;
        EXPECT_FALSE(none.record);
    }
}

// Predictions over a second tell what a second of it makes, of samples at 100 Hz and of those at 25 Hz alike.
TEST(NextRecord, IsPredictedOverAsLongATime) {
    Drifting made(1.0, 0.0, 1.0, 4000);
    made.study.horizon = 100;
    EXPECT_THAT(made.sharper().text,
                HasSubstr(Drifting::words(Drifting::told(4001, 0.01, 100), Drifting::told(3000, 0.04, 25))));
}

// Where nothing is put in it is let go, for as long as it was before.
TEST(NextRecord, OfAFreeMotionIsToLetItGoAgain) {
    const Drifting made(1.0, 0.0, 0.0);
    const gap::Proposal proposal = made.sharper();
    EXPECT_EQ(proposal.text, "let go from as far out as it has been, for 40 s, beside what there is: " +
                                 Drifting::words(Drifting::told(401, 0.1, 401), Drifting::told(400, 0.1, 400)) +
                                 "; by the slopes of what is simulated");
    ASSERT_TRUE(proposal.record);
    EXPECT_EQ(proposal.record->input, std::vector<double>(400, 0.0));
}

// An offset beside it has a slope of 1: by the inverse of both numbers' two by two sums. The one that is narrowed most
// comes first.
TEST(NextRecord, NarrowsSeveralNumbersByWhatIsToldOfBoth) {
    Drifting made;
    made.named.effects.insert(made.named.effects.begin(), &gap::effect_named("sensor_offset"));
    made.named.lasting.insert(made.named.lasting.begin(),
                              gap::parameters_of(*made.named.effects[0], made.study.scales, 0));
    made.named.lasting[0][0].value = 0.0;
    // Deviations of offset and drift, of 401 samples and so many more.
    const auto deviations = [&](int more) {
        double ones = 0.0;
        double times = 0.0;
        for (const int count : {401, more}) {
            for (int i = 0; i < count; ++i) {
                ones += 1.0 / (deviation * deviation);
                times += 0.1 * i / (deviation * deviation);
            }
        }
        ones += Drifting::known_before(Drifting::most_offset);
        const double squares = Drifting::told(401, 0.1, 401) + Drifting::told(more, 0.1, more) +
                               Drifting::known_before(Drifting::most_drift);
        const double determinant = ones * squares - times * times;
        return std::pair(std::sqrt(squares / determinant), std::sqrt(ones / determinant));
    };
    const auto [offset_before, drift_before] = deviations(0);
    const auto [offset_after, drift_after] = deviations(1200);
    const auto words = [](const char* name, double before, double after) {
        return fmt::format("{:.3g} times narrower for {} (within {:.2g} instead of {:.2g})", before / after, name,
                           1.96 * after, 1.96 * before);
    };
    EXPECT_EQ(made.sharper().text, "three fifths, held for 120 s from 0 to 1, beside what there is: " +
                                       words("sensor_drift.per_s", drift_before, drift_after) + ", " +
                                       words("sensor_offset.offset", offset_before, offset_after) +
                                       "; by the slopes of what is simulated");
}

// What training lacks comes before a sharper number; what is ambiguous is parted.
TEST(NextRecord, ComesAfterWhatTrainingLacks) {
    Drifting made;
    const auto next = [&](gap::Outcome outcome, std::vector<std::string> lacking) {
        return gap::next_experiment(
            {outcome, made.study, {&made.named, &made.named}, made.whitener, deviation, 5, std::move(lacking)});
    };
    EXPECT_THAT(next(gap::Outcome::attributed, {}).text, StartsWith("three fifths, held for 120 s"));
    const gap::Proposal after = next(gap::Outcome::attributed, {"falling output", "input above 1"});
    EXPECT_THAT(after.text, StartsWith("train on records that have these, too, as validation has: falling output; "
                                       "input above 1. Then three fifths, held for 120 s"));
    EXPECT_TRUE(after.record);
    made.named.effects = {&gap::effect_named("load_disturbance")};
    made.named.lasting.clear();
    made.named.own[0] = gap::parameters_of(*made.named.effects[0], made.study.scales, 0);
    EXPECT_THAT(next(gap::Outcome::ambiguous, {"falling output"}).text, StartsWith("the same record once more"));
}

}  // namespace
