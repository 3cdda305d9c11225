// What training leaves untold of numbers whose intervals and deviations are given, beside a model that is given.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gap/drive/determined.hpp"
#include "gap/drive/start.hpp"

namespace {

// A lag of 1 s that comes up to 1, and what it is read with.
struct Given {
    std::vector<gap::Record> records;
    gap::Study study;
    gap::Candidate candidate;
    explicit Given(const std::vector<const char*>& effects)
        : study{{gap::form_of(drive::make_fopdt(1.0, 1.0, 0.0)), false}, {}, {}, {}, 0.01, 0.001, 0} {
        gap::Record& record = records.emplace_back();
        record.name = "given";
        record.usual_interval_s = 0.125;
        for (int i = 0; i < 81; ++i) {
            record.time_s.push_back(0.125 * i);
            record.input.push_back(i < 8 ? 0.0 : 1.0);
            record.output.push_back(i < 16 ? 0.0 : 1.0);
        }
        study.counts = gap::all_count(records);
        study.courses.emplace_back(records[0], 1);
        study.scales = gap::scales_of(gap::model_of(study.base.form), records, {});
        candidate.own.resize(1);
        for (const char* effect : effects) {
            candidate.effects.push_back(&gap::effect_named(effect));
            candidate.lasting.push_back(gap::parameters_of(*candidate.effects.back(), study.scales, 0));
            within(candidate.lasting.size() - 1, 0.25, 0.75);
        }
    }
    void within(std::size_t effect, double low, double high) {
        gap::FreeParameter& number = candidate.lasting[effect][0];
        number.value = 0.5 * (low + high);
        number.low = low;
        number.high = high;
    }
    [[nodiscard]] std::string untold(bool needed = false) const {
        return gap::untold_of(study, candidate, [needed](const gap::Effect&) { return needed; });
    }
};

// The ends of an interval belong to it.
TEST(UntoldNumbers, AnIntervalHoldsItsEnds) {
    Given made({"sensor_offset"});
    const std::string first = "training leaves " + made.candidate.lasting[0][0].name;
    EXPECT_EQ(made.untold(), "");
    made.within(0, 0.0, 0.5);
    EXPECT_EQ(made.untold(), first + " anywhere between 0 and 0.5, where 0 is no effect");
    made.within(0, 0.001, 0.5);
    EXPECT_EQ(made.untold(), "");
    made.within(0, -0.5, 0.0);
    EXPECT_EQ(made.untold(), first + " anywhere between -0.5 and 0, where 0 is no effect");
    made.within(0, -0.5, -0.001);
    EXPECT_EQ(made.untold(), "");
    made.within(0, -0.25, 0.5);
    EXPECT_EQ(made.untold(), first + " anywhere between -0.25 and 0.5, where 0 is no effect");
    EXPECT_EQ(made.untold(true), "");  // training needs it, whatever its interval
}

// Of several the first that is untold is named, each by its own numbers.
TEST(UntoldNumbers, TheFirstOfSeveralIsNamed) {
    Given made({"sensor_offset", "sensor_drift"});
    EXPECT_EQ(made.untold(), "");
    made.within(1, -0.5, 0.5);
    EXPECT_EQ(made.untold(), "training leaves " + made.candidate.lasting[1][0].name +
                                 " anywhere between -0.5 and 0.5, where 0 is no effect");
    made.within(0, -0.25, 0.5);
    EXPECT_EQ(made.untold(), "training leaves " + made.candidate.lasting[0][0].name +
                                 " anywhere between -0.25 and 0.5, where 0 is no effect");
}

// A number that stays where it was put is not asked.
TEST(UntoldNumbers, AFixedNumberIsToldByWhoFixedIt) {
    Given made({"sensor_offset"});
    made.within(0, -0.5, 0.5);
    made.candidate.lasting[0][0].fixed = true;
    EXPECT_EQ(made.untold(), "");
}

// Four deviations of an event's size; of noise the best of all times is nearly as large. Its times tell nothing.
TEST(NeededEvents, AreOfMoreThanFourDeviations) {
    const Given made(std::vector<const char*>{});
    const gap::Effect& event = gap::effect_named("load_disturbance");
    const auto needed = [&](double size, double deviation, const std::string& name, double least_size = 0.0) {
        std::vector<gap::FreeParameter> own = gap::parameters_of(event, made.study.scales, 0);
        for (gap::FreeParameter& number : own) {
            number.value = number.name == name ? size : 0.0;
            number.deviation = number.name == name ? deviation : 1.0;
        }
        return gap::needs_event(made.study, own, event, least_size);
    };
    const std::string of_size = "load_disturbance.size";
    for (const double sign : {1.0, -1.0}) {
        EXPECT_TRUE(needed(sign * 4.02, 1.0, of_size));
        EXPECT_FALSE(needed(sign * 4.0, 1.0, of_size));
        EXPECT_FALSE(needed(sign * 3.98, 1.0, of_size));
        EXPECT_TRUE(needed(sign * 0.5, 0.12, of_size));
        EXPECT_FALSE(needed(sign * 0.5, 0.126, of_size));
        EXPECT_FALSE(needed(sign * 9.0, 1.0, "load_disturbance.from_s"));
        EXPECT_TRUE(needed(sign * 9.0, 1.0, of_size, 9.0));
        EXPECT_FALSE(needed(sign * 9.0, 1.0, of_size, 9.1));
    }
    // A record without the event has none of its numbers.
    EXPECT_FALSE(gap::needs_event(made.study, {}, event, 0.0));
}

}  // namespace
