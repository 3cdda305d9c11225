// What is proposed to be measured next: the excitations by their levels, and the words of each verdict.
#include "gap/drive/excitation.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "gap/drive/experiment.hpp"
#include "gap/drive/start.hpp"

namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Of a time constant of 2 s and a record of 40 s.
std::vector<gap::Excitation> usual() { return gap::excitations(2.0, 40.0); }

double at(const gap::Excitation& of, double share) { return of.level(share, share * of.length_s); }

TEST(Excitations, AreAStaircaseUpAndDown) {
    const gap::Excitation stairs = usual()[0];
    EXPECT_EQ(stairs.text, "a staircase of 5 levels up and down, 10 s each");
    EXPECT_EQ(stairs.length_s, 100.0);
    for (int step = 0; step < 10; ++step) {
        for (const double within : {0.001, 0.999}) {
            EXPECT_NEAR(at(stairs, 0.1 * (step + within)), 0.2 * (step < 5 ? step + 1 : 10 - step), 1e-12) << step;
        }
    }
}

TEST(Excitations, AreBitsThatHoldAThirdOfATimeConstant) {
    const gap::Excitation bits = usual()[1];
    EXPECT_THAT(bits.text, HasSubstr("bits of 0.6 s between two fifths and four fifths"));
    EXPECT_EQ(bits.length_s, 120.0);
    int high = 0;
    int changes = 0;
    double before = 0.0;
    for (int bit = 0; bit < 200; ++bit) {
        const double level = at(bits, (0.6 * bit + 0.01) / 120.0);
        EXPECT_TRUE(level == 0.4 || level == 0.8) << level;
        EXPECT_EQ(at(bits, (0.6 * bit + 0.59) / 120.0), level) << bit;
        high += level == 0.8 ? 1 : 0;
        changes += bit > 0 && level != before ? 1 : 0;
        before = level;
    }
    // As a coin would: 100 +- 14.
    EXPECT_NEAR(high, 100, 28);
    EXPECT_NEAR(changes, 100, 28);
}

// Its frequency goes from a fiftieth of the last one's, by as many octaves a second: the turns are its integral.
TEST(Excitations, AreASweptSine) {
    const gap::Excitation sweep = usual()[2];
    EXPECT_THAT(sweep.text, HasSubstr("swept from 0.01 to 0.5 Hz"));
    EXPECT_EQ(sweep.length_s, 120.0);
    double turns = 0.0;
    constexpr int steps = 20000;
    for (int i = 0; i <= steps; ++i) {
        const double share = static_cast<double>(i) / steps;
        if (i % 1000 == 0) {
            EXPECT_NEAR(at(sweep, share), 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turns), 1e-3) << share;
        }
        turns += 0.01 * std::pow(50.0, share + 0.5 / steps) * 120.0 / steps;
    }
}

TEST(Excitations, ArePulsesAndALevelThatIsHeld) {
    const gap::Excitation pulses = usual()[3];
    EXPECT_THAT(pulses.text, HasSubstr("10 s on and off"));
    EXPECT_EQ(pulses.length_s, 60.0);
    const double wanted[] = {1.0 / 3.0, 0.0, 2.0 / 3.0, 0.0, 1.0, 0.0};
    for (int part = 0; part < 6; ++part) {
        EXPECT_NEAR(at(pulses, (part + 0.5) / 6.0), wanted[part], 1e-12) << part;
    }
    EXPECT_EQ(at(pulses, 1.0), 0.0);
    const gap::Excitation held = usual()[4];
    EXPECT_EQ(held.text, "three fifths, held for 120 s");
    EXPECT_EQ(held.length_s, 120.0);
    EXPECT_EQ(at(held, 0.7), 0.6);
}

// A record of more than thirty holds of five time constants may show what is slower than these.
TEST(Excitations, AreAsLongAsTheRecordWhereThatIsLong) {
    EXPECT_EQ(gap::excitations(2.0, 300.0).size(), 5U);
    const auto all = gap::excitations(2.0, 301.0);
    ASSERT_EQ(all.size(), 6U);
    EXPECT_EQ(all[5].text, "a staircase of 5 levels up and down, 30.1 s each");
    EXPECT_EQ(all[5].length_s, 301.0);
    EXPECT_NEAR(at(all[5], 0.45), 1.0, 1e-12);
}

// --- The words, where nothing is simulated.

std::string words(gap::Outcome outcome, std::size_t levels, std::vector<std::string> extrapolated) {
    gap::Record record;
    record.usual_interval_s = 1.0;
    record.time_s = {0.0, 1.0, 2.0};
    record.input = {0.0, 1.0, 1.0};
    record.output = {0.0, 1.0, 2.0};
    const drive::Model model = drive::make_fopdt(1.0, 1.0, 0.0);
    const gap::Study study{{gap::form_of(model), false}, gap::scales_of(model, {record}, {}), {}, {}, 0.1, 0.1, 0};
    const gap::Whitener whitener;
    return gap::next_experiment({outcome, study, {}, whitener, 0.1, levels, std::move(extrapolated)}).text;
}

TEST(NextWords, OfNoGapAskForAnotherProfile) {
    EXPECT_THAT(words(gap::Outcome::no_gap, 5, {}), StartsWith("none for this gap; another operating profile"));
    EXPECT_EQ(words(gap::Outcome::no_gap, 5, {"falling output", "input above 1"}),
              "none for this gap, though validation alone has these: falling output; input above 1");
}

TEST(NextWords, OfAnUnknownGoByWhatThereWas) {
    EXPECT_THAT(
        words(gap::Outcome::unknown, 9, {"falling output"}),
        StartsWith(
            "train on records that have these, too, as validation has: falling output. Training never went there"));
    EXPECT_THAT(words(gap::Outcome::unknown, 3, {}), StartsWith("a staircase up and down with at least 5 levels"));
    EXPECT_THAT(words(gap::Outcome::unknown, 4, {}), StartsWith("the same record twice more"));
}

// --- What a record would tell of a number whose slopes are known: a drift's are the time itself.

struct Drifting {
    std::vector<gap::Record> records;
    gap::Study study;
    gap::Candidate named;
    gap::Whitener whitener;
    Drifting() : study{{gap::form_of(drive::make_fopdt(1.0, 1.0, 0.0)), false}, {}, {}, {}, 0.01, 0.001, 0} {
        gap::Record record;
        record.name = "drifts";
        record.usual_interval_s = 0.1;
        for (int i = 0; i < 401; ++i) {
            record.time_s.push_back(0.1 * i);
            record.input.push_back(i < 200 ? 1.0 : 0.0);
            record.output.push_back(0.0);
        }
        records = {record};
        study.counts = gap::all_count(records);
        study.courses.emplace_back(records[0], 1);
        records[0].output[100] = 1.0;  // how far it goes
        study.scales = gap::scales_of(gap::model_of(study.base.form), records, {});
        named.effects = {&gap::effect_named("sensor_drift")};
        named.own.resize(1);
        named.lasting = {gap::parameters_of(*named.effects[0], study.scales, 0)};
        named.lasting[0][0].value = 1e-4;
        records[0].output = gap::simulate(gap::scenario_of(study, named, 0), study.courses[0]);
        whitener.deviation = whitener.stationary_deviation = 0.02;
    }
    // Of so many samples a tenth of a second apart, by a deviation of 0.02.
    static double information(int samples) {
        double squares = 0.0;
        for (int i = 0; i < samples; ++i) {
            squares += 0.01 * i * i;
        }
        return squares / (0.02 * 0.02);
    }
    // As of values that are spread evenly over its bounds.
    [[nodiscard]] double prior() const {
        const double half = 0.5 * (named.lasting[0][0].upper - named.lasting[0][0].lower);
        return 3.0 / (half * half);
    }
};

TEST(Sharpened, IsWhatTheSlopesOfTheLongestRecordTell) {
    const Drifting made;
    // Three times as long as the record, 1203 samples: no other excitation is.
    const double before = 1.96 / std::sqrt(Drifting::information(401) + made.prior());
    const double after = 1.96 / std::sqrt(Drifting::information(401) + Drifting::information(1200) + made.prior());
    EXPECT_EQ(gap::sharpen(made.study, made.named, made.whitener).text,
              fmt::format("three fifths, held for 120 s from 0 to 1, beside what there is: {:.3g} times narrower for "
                          "sensor_drift.per_s (within {:.2g} instead of {:.2g}); by the slopes of what is simulated",
                          before / after, after, before));
    // What is drawn of it: three fifths held, and a drift of the output alone.
    const auto record = gap::sharpen(made.study, made.named, made.whitener).record;
    ASSERT_TRUE(record);
    EXPECT_EQ(record->text, "three fifths, held for 120 s from 0 to 1");
    EXPECT_EQ(record->input, std::vector<double>(record->time_s.size(), 0.6));
    ASSERT_EQ(record->outputs.size(), 1U);
    EXPECT_EQ(record->outputs[0].first, made.named.name());
    EXPECT_EQ(record->outputs[0].second.size(), record->time_s.size());
}

// Where what is left is larger than the noise, intervals are as much wider, before and behind.
TEST(Sharpened, IsNoNarrowerForAMisfit) {
    Drifting made;
    for (std::size_t i = 0; i < made.records[0].size(); ++i) {
        made.records[0].output[i] += i % 2 == 0 ? 0.06 : -0.06;
    }
    const double n = 401.0;
    const double variance = 9.0 * n / (n - 1.0);
    const double before = 1.96 / std::sqrt(Drifting::information(401) / variance + made.prior());
    EXPECT_THAT(gap::sharpen(made.study, made.named, made.whitener).text,
                HasSubstr(fmt::format("instead of {:.2g})", before)));
}

// By a fifth at least. Of noise so large that a number's bounds tell most of it: three more records of 1200 samples in
// all narrow it by what they tell over that.
TEST(Sharpened, IsWorthWhatNarrowsByAFifth) {
    Drifting made;
    const auto said = [&](double times) {
        const double now = Drifting::information(401) * 0.02 * 0.02;
        const double added = Drifting::information(1200) * 0.02 * 0.02;
        const double variance = (added / (times * times - 1.0) - now) / made.prior();
        made.whitener.deviation = made.whitener.stationary_deviation = std::sqrt(variance);
        return gap::sharpen(made.study, made.named, made.whitener).text;
    };
    EXPECT_THAT(said(1.203), HasSubstr("1.2 times narrower for sensor_drift.per_s"));
    EXPECT_THAT(said(1.197), StartsWith("a record at other levels and speeds"));
}

TEST(Sharpened, OfAnEventIsTheSameRecordAgain) {
    Drifting made;
    made.named.effects = {&gap::effect_named("load_disturbance")};
    made.named.lasting.clear();
    made.named.own[0] = gap::parameters_of(*made.named.effects[0], made.study.scales, 0);
    EXPECT_THAT(gap::sharpen(made.study, made.named, made.whitener).text, StartsWith("the same record once more"));
    EXPECT_FALSE(gap::sharpen(made.study, made.named, made.whitener).record) << "nothing was simulated";
    // What has no number is tested elsewhere.
    made.named.effects = {&gap::effect_named("sensor_magnitude")};
    made.named.lasting = {gap::parameters_of(*made.named.effects[0], made.study.scales, 0)};
    made.named.own[0].clear();
    EXPECT_THAT(gap::sharpen(made.study, made.named, made.whitener).text,
                StartsWith("a record at other levels and speeds"));
}

}  // namespace
