// Fits whose result is known: of offsets and drifts, which are linear, by least squares; at bounds; of events.
#include "gap/drive/fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gap/drive/determined.hpp"
#include "gap/drive/start.hpp"

namespace {

struct Made {
    std::vector<gap::Record> records;
    gap::Study study;
    explicit Made(std::size_t count = 1, bool refit = false)
        : study{{gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)), refit}, {}, {}, {}, 0.01, 0.001, 0} {
        gap::Record record;
        record.name = "made";
        record.usual_interval_s = 0.1;
        for (int i = 0; i < 300; ++i) {
            record.time_s.push_back(0.1 * i);
            record.input.push_back((i / 60) % 2 == 0 ? 0.0 : 1.0);
            record.output.push_back(0.0);
        }
        records.assign(count, record);
        study.counts = gap::all_count(records);
        for (const gap::Record& one : records) {
            study.courses.emplace_back(one, 1);
        }
        const auto plain = simulated();
        for (gap::Record& one : records) {
            one.output = plain;
        }
        study.scales = gap::scales_of(gap::model_of(study.base.form), records, {});
    }
    [[nodiscard]] std::vector<double> simulated() const {
        gap::Scenario plain;
        plain.model = gap::model_of(study.base.form);
        return gap::simulate(plain, study.courses[0]);
    }
    // Adds to each reading of a record.
    template <class Added>
    void add(const Added& added, std::size_t record = 0) {
        for (std::size_t i = 0; i < records[record].size(); ++i) {
            records[record].output[i] += added(records[record].time_s[i]);
        }
    }
};

const gap::Effect& offset() { return gap::effect_named("sensor_offset"); }
const gap::Effect& drift() { return gap::effect_named("sensor_drift"); }

TEST(Fit, OfWhatIsLinearIsExact) {
    Made made;
    made.add([](double t) { return 0.3 - 0.02 * t; });
    const gap::Candidate found = gap::fit(made.study, {&offset(), &drift()}, {}, nullptr);
    EXPECT_NEAR(found.lasting[0][0].value, 0.3, 1e-6);
    EXPECT_NEAR(found.lasting[1][0].value, -0.02, 1e-7);
    EXPECT_LT(found.cost, 1e-9);
    // Half the squares of what is left.
    const gap::Candidate none = gap::fit(made.study, {}, {}, nullptr);
    double squares = 0.0;
    for (const double t : made.records[0].time_s) {
        squares += 0.5 * std::pow(0.3 - 0.02 * t, 2);
    }
    EXPECT_NEAR(none.cost, squares, 1e-9);
    EXPECT_TRUE(none.lasting.empty());
}

// What is cut off at its bound stays there, and the others go on: the best drift beside an offset that is 1 too small.
TEST(Fit, HoldsWhatLiesAtItsBound) {
    Made made;
    const double bound = made.study.scales.output_span;
    made.add([&](double) { return bound + 1.0; });
    const gap::Candidate found = gap::fit(made.study, {&offset(), &drift()}, {}, nullptr);
    EXPECT_NEAR(found.lasting[0][0].value, bound, 1e-5);
    double along = 0.0;
    double square = 0.0;
    for (const double t : made.records[0].time_s) {
        along += t;
        square += t * t;
    }
    EXPECT_NEAR(found.lasting[1][0].value, std::min(along / square, found.lasting[1][0].upper), 1e-4);
}

TEST(Fit, PassesOverWhatDoesNotCount) {
    Made made;
    made.add([](double t) { return t < 10.0 ? 7.0 : 0.3; });
    for (std::size_t i = 0; i < 300; ++i) {
        made.study.counts[0][i] = made.records[0].time_s[i] < 10.0 - 1e-9 ? 0 : 1;
    }
    const gap::Candidate found = gap::fit(made.study, {&offset()}, {}, nullptr);
    EXPECT_NEAR(found.lasting[0][0].value, 0.3, 1e-6);
    EXPECT_LT(found.cost, 1e-9);
}

// Whitened by half of the sample before, an offset leaves half of itself.
TEST(Fit, CountsWhitenedResiduals) {
    Made made;
    made.add([](double) { return 0.3; });
    gap::Whitener whitener;
    whitener.coefficients = {0.5};
    whitener.deviation = 0.1;
    whitener.stationary_deviation = 0.2;
    const gap::Candidate none = gap::fit(made.study, {}, {}, &whitener);
    EXPECT_NEAR(none.cost, 0.5 * (std::pow(0.3 / 0.2, 2) + 299.0 * std::pow(0.15 / 0.1, 2)), 1e-6);
    EXPECT_NEAR(gap::fit(made.study, {&offset()}, {}, &whitener).lasting[0][0].value, 0.3, 1e-6);
}

TEST(Fit, BeginsWhereTheStartIs) {
    Made made;
    made.add([](double) { return 0.3; });
    gap::Candidate start = gap::fit(made.study, {&offset()}, {}, nullptr);
    start.lasting[0][0].value = 0.125;
    const gap::Candidate there = gap::fit(made.study, {&offset()}, start, nullptr, {0, 1, 0});
    EXPECT_EQ(there.lasting[0][0].value, 0.125);
    EXPECT_NEAR(there.cost, 0.5 * 300.0 * 0.175 * 0.175, 1e-9);
    // Another effect beside it begins at its own start.
    const gap::Candidate both = gap::fit(made.study, {&drift(), &offset()}, start, nullptr, {0, 1, 0});
    EXPECT_EQ(both.lasting[1][0].value, 0.125);
    EXPECT_EQ(both.lasting[0][0].value, gap::parameters_of(drift(), made.study.scales, 0)[0].value);
    // What is hopeless by then goes no further.
    const gap::Candidate hopeless = gap::fit(made.study, {&offset()}, start, nullptr, {0, 1, 25, 1e-9});
    EXPECT_EQ(hopeless.lasting[0][0].value, 0.125);
    EXPECT_NEAR(gap::fit(made.study, {&offset()}, start, nullptr, {0, 1, 25, 1e9}).lasting[0][0].value, 0.3, 1e-6);
}

// Of two starts the better one.
TEST(Fit, TakesTheBestOfAnEffectsStarts) {
    Made made;
    const gap::Effect& gain = gap::effect_named("gain_error");
    ASSERT_EQ(gap::starts_of(gain, made.study.scales), 2U);
    gap::Scenario truth;
    truth.model = gap::model_of(made.study.base.form);
    gain.add_to(truth, std::vector{1.35});
    made.records[0].output = gap::simulate(truth, made.study.courses[0]);
    const gap::Candidate first = gap::fit(made.study, {&gain}, {}, nullptr, {0, 1, 0});
    EXPECT_EQ(first.lasting[0][0].value, 1.4);  // of 0.7 and 1.4
    EXPECT_NEAR(gap::fit(made.study, {&gain}, {}, nullptr).lasting[0][0].value, 1.35, 1e-5);
}

// A base that is fitted: with any effect a fit goes as far as what it was begun from.
TEST(Fit, OfAFittedBaseIsNeverWorseThanWithoutTheEffect) {
    Made made(1, true);
    std::mt19937_64 engine(1);
    std::normal_distribution<double> normal(0.0, 0.05);
    made.add([&](double) { return normal(engine); });
    const gap::Candidate none = gap::fit(made.study, {}, {}, nullptr);
    EXPECT_NEAR(none.base[0].value, 2.0, 0.05);
    EXPECT_NEAR(none.base[1].value, 1.0, 0.1);
    for (const char* effect : {"input_saturation", "backlash"}) {
        EXPECT_LE(gap::fit(made.study, {&gap::effect_named(effect)}, none, nullptr).cost, none.cost * (1.0 + 1e-9))
            << effect;
    }
}

// Up a staircase beyond an end a base that was fitted without it is another plant, and so are the states of its
// records.
TEST(Fit, OfAnEndBeginsAtTheFormsNumbers) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 0.1;
    for (int i = 0; i < 300; ++i) {
        record.time_s.push_back(0.1 * i);
        record.input.push_back(i / 50);
        record.output.push_back(0.0);
    }
    const drive::Model plant = drive::make_fopdt(2.0, 1.0, 0.5);
    for (const auto& [name, values] :
         {std::pair<const char*, std::vector<double>>("input_saturation", {2.6}), {"end_stop", {5.2, 0.0, 0.0, 0.0}}}) {
        const gap::Effect& end = gap::effect_named(name);
        gap::Scenario scenario;
        scenario.model = plant;
        end.add_to(scenario, values);
        record.output = gap::simulate(scenario, gap::Course(record, 2));
        gap::Study study{{gap::form_of(plant), true}, {}, {}, {}, 0.01, 0.001, 0};
        study.scales = gap::scales_of(plant, {record}, {});
        study.counts = gap::all_count({record});
        study.courses.emplace_back(record, 2);
        gap::Candidate astray = gap::fit(study, {}, {}, nullptr, {0, 1, 0});
        astray.base[0].value = -0.4;
        astray.base[1].value = 30.0;
        astray.base[2].value = 5.6;  // a step late, which looks like an offset
        astray.own[0][1].value = 9.0;
        const gap::Candidate found = gap::fit(study, {&end}, astray, nullptr, {4, 1, 9});
        EXPECT_NEAR(found.lasting[0][0].value, values[0], 0.01) << name;
        EXPECT_NEAR(found.base[0].value, 2.0, 0.02) << name;
        EXPECT_NEAR(found.base[2].value, 0.5, 0.02) << name;
        EXPECT_LT(found.cost, 1e-3) << name;
    }
}

// Of what leaves as much the one with fewer numbers; each more has to leave 15 % less.
TEST(Fit, WeighsVariantsByTheirNumbers) {
    const Made made(1, true);
    const gap::Effect& stop = gap::effect_named("end_stop");
    gap::Candidate candidate;
    candidate.effects = {&stop};
    candidate.lasting = {gap::parameters_of(stop, made.study.scales, 0)};
    candidate.own.resize(1);
    candidate.cost = 2.0;
    std::size_t free = 0;
    for (const gap::FreeParameter& number : candidate.lasting[0]) {
        free += number.fixed ? 0 : 1;
    }
    ASSERT_GE(free, 1U);
    EXPECT_NEAR(gap::weighed_cost(candidate), 2.0 / std::pow(0.85, static_cast<double>(free)), 1e-12);
    candidate.lasting[0][0].fixed = true;
    EXPECT_NEAR(gap::weighed_cost(candidate), 2.0 / std::pow(0.85, static_cast<double>(free - 1)), 1e-12);
}

TEST(Fit, MayBeginAtOneStartAlone) {
    const Made made(1, false);
    const gap::Effect& curve = gap::effect_named("output_curve");
    ASSERT_GE(gap::starts_of(curve, made.study.scales), 2U);
    for (const std::size_t start : {0U, 1U}) {
        gap::Effort effort{0, 1, 0};
        effort.only_start = start;
        const gap::Candidate begun = gap::fit(made.study, {&curve}, {}, nullptr, effort);
        EXPECT_EQ(begun.lasting[0][0].value, start == 0 ? -0.25 : 0.25);
    }
}

// Before the base may follow, a new effect meets it as it is.
TEST(Fit, OfAFittedBaseANewEffectMovesFirst) {
    Made made(1, true);
    made.add([](double t) { return 0.01 * t; });
    const gap::Candidate base = gap::fit(made.study, {}, {}, nullptr, {0, 1, 0});
    const gap::Candidate found = gap::fit(made.study, {&drift()}, base, nullptr, {0, 1, 0});
    EXPECT_NEAR(found.lasting[0][0].value, 0.01, 2e-3);
    EXPECT_LT(found.cost, 0.05 * base.cost);
    for (std::size_t i = 0; i < base.base.size(); ++i) {
        EXPECT_EQ(found.base[i].value, base.base[i].value) << base.base[i].name;
    }
}

// Where nothing better is found, exactly that, with the effect's numbers at the values that are none.
TEST(Fit, OfAFittedBaseMayLeaveANewEffectOut) {
    const Made made(1, true);
    const gap::Candidate none = gap::fit(made.study, {}, {}, nullptr);
    const gap::Effect& gain = gap::effect_named("gain_error");
    const gap::Effect& curve = gap::effect_named("output_curve");
    const gap::Candidate found = gap::fit(made.study, {&gain, &curve}, none, nullptr, {0, 1, 0});
    EXPECT_NEAR(found.cost, none.cost, 1e-12);
    EXPECT_EQ(found.lasting[0][0].value, 1.0);
    EXPECT_EQ(found.lasting[1][0].value, 0.0);
    for (std::size_t i = 0; i < none.base.size(); ++i) {
        EXPECT_EQ(found.base[i].value, none.base[i].value) << none.base[i].name;
    }
    // An effect that was known before stays as it was.
    gap::Candidate known = gap::fit(made.study, {&curve}, none, nullptr, {0, 1, 0});
    known.lasting[0][0].value = 0.05;
    const gap::Candidate kept = gap::fit(made.study, {&curve, &gain}, known, nullptr, {0, 1, 0});
    EXPECT_NE(kept.lasting[0][0].value, 0.0);
}

// A threshold between two levels of the input moves no reading: it is known as far as nothing becomes less likely, in
// sixteenths of the way to its bounds.
TEST(Intervals, OfWhatMovesNothingReachAsFarAsIsLikely) {
    Made made;
    for (std::size_t i = 0; i < 300; ++i) {
        made.records[0].input[i] = i < 100 ? 0.0 : i < 200 ? 0.4 : 1.0;
    }
    made.study.courses.clear();
    made.study.courses.emplace_back(made.records[0], 1);
    const gap::Effect& threshold = gap::effect_named("start_up_threshold");
    gap::Candidate candidate;
    candidate.effects = {&threshold};
    candidate.lasting = {gap::parameters_of(threshold, made.study.scales, 0)};
    candidate.own = {gap::state_of(made.study, made.records[0])};
    gap::FreeParameter& number = candidate.lasting[0][0];
    number.value = 0.6;
    number.upper = 1.5;
    gap::Scenario truth = gap::scenario_of(made.study, candidate, 0);
    made.records[0].output = gap::simulate(truth, made.study.courses[0]);
    std::mt19937_64 engine(1);
    std::normal_distribution<double> normal(0.0, 0.01);
    made.add([&](double) { return normal(engine); });
    gap::Whitener whitener;
    whitener.deviation = whitener.stationary_deviation = 0.01;
    for (const gap::Whitener* by :
         {static_cast<const gap::Whitener*>(nullptr), static_cast<const gap::Whitener*>(&whitener)}) {
        gap::add_intervals(made.study, candidate, by);
        EXPECT_EQ(number.value, 0.6);
        const double down = (0.6 - number.lower) / 16.0;
        EXPECT_NEAR(number.low, 0.6 - down * std::floor((0.6 - 0.4) / down), 1e-12);
        EXPECT_NEAR(number.high, 0.6 + 0.9 / 16.0 * std::floor((1.0 - 0.6) / (0.9 / 16.0)), 1e-12);
    }
    // What does not count tells nothing: without the readings under the lower level, and on the way
    // from there, it may lie below.
    for (std::size_t i = 100; i < 300; ++i) {
        made.study.counts[0][i] = i < 280 ? 0 : 1;
    }
    gap::add_intervals(made.study, candidate, nullptr);
    EXPECT_LT(number.low, 0.4);
    EXPECT_LT(number.high, 1.0);
}

// Events happen at times of their own in each record; what lasts keeps its number.
TEST(CarriedOver, KeepsWhatLastsAndFindsEventsAnew) {
    Made train(2);
    const gap::Effect& disturbance = gap::effect_named("load_disturbance");
    const auto with = [&](Made& made, std::size_t record, double from_s, double to_s) {
        gap::Scenario truth;
        truth.model = gap::model_of(made.study.base.form);
        truth.forces.pushes.push_back({from_s, to_s, 0.4});
        const auto moved = gap::simulate(truth, made.study.courses[record]);
        const auto plain = made.simulated();
        for (std::size_t i = 0; i < moved.size(); ++i) {
            made.records[record].output[i] += moved[i] - plain[i] + 0.2;
        }
    };
    with(train, 0, 5.0, 9.0);
    with(train, 1, 12.0, 20.0);
    const gap::Candidate fitted = gap::fit(train.study, {&disturbance, &offset()}, {}, nullptr);
    EXPECT_NEAR(fitted.lasting[0][0].value, 0.2, 0.01);
    const auto expect_event = [](const std::vector<gap::FreeParameter>& own, double from_s, double to_s) {
        EXPECT_NEAR(own[0].value, from_s, 0.1);
        EXPECT_NEAR(own[1].value, to_s, 0.1);
        EXPECT_NEAR(own[2].value, 0.4, 0.02);
    };
    expect_event(fitted.own[0], 5.0, 9.0);
    expect_event(fitted.own[1], 12.0, 20.0);
    Made other;
    with(other, 0, 15.0, 22.0);
    const gap::Candidate carried = gap::carried_over(other.study, fitted, nullptr);
    EXPECT_EQ(carried.lasting[0][0].value, fitted.lasting[0][0].value);
    ASSERT_EQ(carried.own.size(), 1U);
    expect_event(carried.own[0], 15.0, 22.0);
    EXPECT_LT(carried.cost, 0.05);
}

// Events are guessed beside the base as it is: a level that the record's own operating point takes up, and no other
// number, hides no jump of a seventh of it.
TEST(CarriedOver, GuessesEventsWhereTheStateHasTakenUpTheLevel) {
    const gap::Effect& jumps = gap::effect_named("missed_counts");
    Made train(1, true);
    train.add([](double t) { return t > 14.95 ? 0.5 : 0.0; });
    const gap::Candidate fitted =
        gap::fit(train.study, {&jumps}, gap::fit(train.study, {}, {}, nullptr), nullptr, {0, 1, 5});
    Made other(1, true);
    gap::Record& record = other.records.front();
    record.input.assign(record.size(), 1.0);
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.output[i] = 4.0 + (record.time_s[i] > 19.95 ? 0.3 : 0.0);
    }
    other.study.courses.clear();
    other.study.courses.emplace_back(record, 1);
    const gap::Candidate carried = gap::carried_over(other.study, fitted, nullptr);
    for (std::size_t i = 0; i < fitted.base.size(); ++i) {
        EXPECT_EQ(carried.base[i].value, fitted.base[i].value) << fitted.base[i].name;
    }
    const auto number = [&](const std::string& name) {
        return std::ranges::find(carried.own[0], "missed_counts." + name, &gap::FreeParameter::name)->value;
    };
    EXPECT_NEAR(number("at_s"), 19.95, 1e-9);
    EXPECT_NEAR(number("size"), 0.3, 0.01);
}

}  // namespace
