// What speaks against an event: each reason, at its edge, of records and numbers by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gap/drive/outside.hpp"
#include "gap/drive/start.hpp"

namespace {

using testing::HasSubstr;

constexpr double delay_s = 0.2;
constexpr double time_constant_s = 0.5;

// 20 s at 100 Hz; the input steps up at 5 s and down at 12 s.
gap::Record stepped(const char* name) {
    gap::Record record;
    record.name = name;
    record.usual_interval_s = 0.01;
    for (int i = 0; i <= 2000; ++i) {
        record.time_s.push_back(0.01 * i);
        record.input.push_back(i >= 500 && i < 1200 ? 1.0 : 0.0);
        record.output.push_back(0.0);
    }
    return record;
}

struct Force {
    double from_s;
    double to_s;
    double size = 1.0;
};

// A record to train on and one to judge, each with a force.
class DoubtOfEvents : public testing::Test {
protected:
    DoubtOfEvents() : records_{stepped("train"), stepped("judge")}, train_(study_of(0)), judge_(study_of(1)) {}
    gap::Study study_of(std::size_t record) const {
        gap::Study study{{gap::form_of(drive::make_fopdt(2.0, time_constant_s, delay_s))}, {}, {}, {}, 0.01, 0.001, 0};
        study.scales.time_constant_s = time_constant_s;
        study.courses.emplace_back(records_[record], 1);
        return study;
    }
    gap::Candidate candidate_of(const Force& force) const {
        gap::Candidate one;
        one.effects = {&gap::effect_named(effect_)};
        const auto number = [](const std::string& name, double value) {
            return gap::FreeParameter{.name = name, .value = value, .lower = -20.0, .upper = 20.0, .scale = 1.0};
        };
        const std::string prefix = effect_ + ".";
        one.own = {{number("initial_output", 0.0), number(prefix + "from_s", force.from_s),
                    number(prefix + "to_s", force.to_s), number(prefix + "size", force.size)}};
        one.own[0][0].fixed = at_rest_;
        return one;
    }
    std::string doubt(const Force& train, const Force& judge) const {
        return gap::doubt_of_events(train_, candidate_of(train), judge_, candidate_of(judge));
    }

    const Force somewhere_{8.0, 9.0};
    std::string effect_ = "load_disturbance";
    bool at_rest_ = true;
    std::vector<gap::Record> records_;
    gap::Study train_;
    gap::Study judge_;
};

TEST_F(DoubtOfEvents, OfWhatComesFromOutsideThereIsNone) { EXPECT_EQ(doubt(somewhere_, {15.0, 17.0}), ""); }

// A dead time and three time constants after the first move the drive has settled.
TEST_F(DoubtOfEvents, BeginsWithTheInputAndLasts) {
    constexpr double settled_s = 5.0 + delay_s + 3.0 * time_constant_s;
    EXPECT_THAT(doubt(somewhere_, {settled_s - 0.05, 20.0}), HasSubstr("load_disturbance of judge begins with the"));
    EXPECT_THAT(doubt({settled_s - 0.05, 20.0}, somewhere_), HasSubstr("load_disturbance of train begins with the"));
    EXPECT_EQ(doubt(somewhere_, {settled_s + 0.05, 20.0}), "");
}

TEST_F(DoubtOfEvents, BeginsBeforeTheInputCanAct) {
    at_rest_ = false;
    EXPECT_THAT(doubt(somewhere_, {delay_s - 0.05, 2.0}), HasSubstr("of judge begins before its input can act"));
    EXPECT_EQ(doubt(somewhere_, {delay_s + 0.05, 2.0}), "");
    at_rest_ = true;
    EXPECT_EQ(doubt(somewhere_, {delay_s - 0.05, 2.0}), "");
}

// Below a twentieth of the largest a force is not felt: how long it lasts says nothing.
TEST_F(DoubtOfEvents, IsOfForcesThatAreFelt) {
    for (const double sign : {1.0, -1.0}) {
        EXPECT_EQ(doubt({8.0, 9.0, 2.0}, {5.5, 20.0, 0.0995 * sign}), "");
        EXPECT_NE(doubt({8.0, 9.0, 2.0}, {5.5, 20.0, 0.1005 * sign}), "");
        EXPECT_EQ(doubt({5.5, 20.0, 0.1095 * sign}, {8.0, 9.0, -2.2}), "");
    }
    EXPECT_EQ(doubt({8.0, 9.0}, {5.5, 20.0, 0.0}), "");  // none at all
}

TEST_F(DoubtOfEvents, FeelsATwentiethOfTheLargest) {
    const gap::Effect& load = gap::effect_named(effect_);
    const auto least = [&](double train, double judge) {
        return gap::least_felt(load, candidate_of({8.0, 9.0, train}), candidate_of({8.0, 9.0, judge}));
    };
    EXPECT_NEAR(least(2.0, -0.3), 0.1, 1e-12);
    EXPECT_NEAR(least(0.3, -2.0), 0.1, 1e-12);
    EXPECT_EQ(gap::least_felt(gap::effect_named("sensor_offset"), candidate_of(somewhere_), candidate_of(somewhere_)),
              0.0);
}

// Forces that begin near a move, a dead time later, in one record after the other.
TEST_F(DoubtOfEvents, MeetsTheInputTooOftenForChance) {
    const auto after = [&](double late_s) { return doubt({5.2 + late_s, 7.0}, {12.2 + late_s, 15.0}); };
    // Of two moves 4 t of 20 s lie as near; Fisher's joint chance p^2 (1 - ln p^2) is 0.006 where p = 0.02701.
    EXPECT_THAT(after(0.13), HasSubstr("begins with a move of the input in every record, by chance once in 1.8e+02"));
    EXPECT_NE(after(0.1349), "");
    EXPECT_EQ(after(0.1352), "");
}

// The input is 1 from 5 to 12 s and acts from 5.2 to 12.2 s, with a gain of 2.
TEST_F(DoubtOfEvents, UndoesTheInputThatStays) {
    const auto undoes = [&](const Force& force) {
        return doubt(somewhere_, force).find("of judge undoes the input as long as it lasts") != std::string::npos;
    };
    EXPECT_TRUE(undoes({7.0, 11.0, -2.0}));
    EXPECT_TRUE(undoes({5.2, 6.0, -2.095}));
    EXPECT_TRUE(undoes({5.2, 6.0, -1.905}));
    EXPECT_FALSE(undoes({5.2, 6.0, -2.105}));
    EXPECT_FALSE(undoes({5.2, 6.0, -1.895}));
    EXPECT_FALSE(undoes({7.0, 11.0, 2.0}));
    EXPECT_FALSE(undoes({5.0, 6.0, -2.0}));    // 0.2 s of it before the input acts
    EXPECT_FALSE(undoes({11.0, 12.5, -2.0}));  // or after
    EXPECT_FALSE(undoes({11.0, 13.5, -1.0}));  // nor is it the mean of both
    EXPECT_TRUE(undoes({11.0, 12.2, -2.0}));
    EXPECT_FALSE(undoes({13.0, 14.0, -2.0}));
    EXPECT_THAT(doubt({7.0, 11.0, -2.0}, somewhere_), HasSubstr("of train undoes the input"));
    effect_ = "missed_counts";  // readings are no force
    EXPECT_FALSE(undoes({7.0, 11.0, -2.0}));
}

TEST_F(DoubtOfEvents, IsOfEventsAlone) {
    effect_ = "sensor_offset";
    EXPECT_EQ(doubt(somewhere_, {5.5, 20.0}), "");
}

// 100 s at 10 Hz: the input steps to 8 at 10 s and falls a little at 60 s, where something happens. As a move it is met
// to half an interval, as is the step; else the step is 50 s away, and 60 s of 100 lie as near.
TEST(ChanceOfMeeting, IsOfMovesOfThreeHundredthsOfTheInput) {
    const auto chance = [](double share) {
        gap::Record record;
        record.usual_interval_s = 0.1;
        for (int i = 0; i <= 1000; ++i) {
            record.time_s.push_back(0.1 * i);
            record.input.push_back(i < 100 ? 0.0 : i < 600 ? 8.0 : 8.0 - share * 8.0);
            record.output.push_back(0.0);
        }
        return gap::chance_of_meeting(record, 60.0, 0.0);
    };
    EXPECT_NEAR(chance(0.02985), 0.6, 1e-9);
    EXPECT_NEAR(chance(0.03015), 0.002, 1e-9);
}

}  // namespace
