// Whether an input comes again by itself, and whether a wave is in step with it.
#include "gap/drive/in_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "gap/drive/start.hpp"

namespace {

// 40 s at 100 Hz: off, and on or off from each of these times on.
gap::Record switched(const std::vector<double>& at_s, double second_level = 1.0) {
    gap::Record record;
    record.name = "switched";
    record.usual_interval_s = 0.01;
    for (int i = 0; i <= 4000; ++i) {
        const double t = 0.01 * i;
        std::size_t moves = 0;
        while (moves < at_s.size() && t > at_s[moves] - 0.005) {
            ++moves;
        }
        record.time_s.push_back(t);
        record.input.push_back(moves % 2 == 0 ? 0.0 : moves == 3 ? second_level : 1.0);
        record.output.push_back(0.0);
    }
    return record;
}

TEST(InStep, AnInputComesAgainWhereItsMovesAreAsFarApart) {
    const auto period = [](const gap::Record& record) { return gap::input_period_s(record).value_or(0.0); };
    EXPECT_NEAR(period(switched({3.0, 10.0, 17.0, 24.0, 31.0})), 14.0, 1e-9);
    EXPECT_NEAR(period(switched({3.0, 5.0, 13.0, 15.0})), 10.0, 1e-9);  // 2 s of every 10
    EXPECT_NEAR(period(switched({3.0, 5.0, 13.0, 15.1})), 10.05, 1e-9);
    EXPECT_EQ(period(switched({3.0, 5.0, 13.0, 15.3})), 0.0);  // further off than a fiftieth
    EXPECT_EQ(period(switched({3.0, 5.0, 13.0})), 0.0);        // one move that was there before
    EXPECT_EQ(period(switched({})), 0.0);
    EXPECT_EQ(period(switched({3.0, 5.0, 13.0, 15.0}, 0.9)), 0.0);  // to another level
    EXPECT_NEAR(period(switched({3.0, 5.0, 13.0, 15.0}, 0.98)), 10.0, 1e-9);
}

TEST(InStep, AWaveIsTheDrivesOwnWhereItsPeriodIsTheInputs) {
    const gap::Record again = switched({3.0, 5.0, 13.0, 15.0});
    const gap::Record once = switched({3.0});
    gap::Study study{{gap::form_of(drive::make_fopdt(2.0, 0.5, 0.2))}, {}, {}, {}, 0.01, 0.001, 0};
    study.courses.emplace_back(once, 1);
    const auto in_step = [&](double period_s, const char* name = "variable_delay") {
        gap::Candidate one;
        one.effects = {&gap::effect_named("quadratic_drag"), &gap::effect_named(name)};
        const auto number = [](double value) { return gap::FreeParameter{"", value, 0.0, 100.0, 1.0}; };
        one.lasting = {{number(0.1), number(10.0)}, {number(0.1), number(period_s), number(0.0)}};
        return gap::in_step_with_input(study, one);
    };
    EXPECT_EQ(in_step(10.0), "");
    study.courses.emplace_back(again, 1);
    EXPECT_EQ(in_step(10.0), "variable_delay comes again every 10 s, as the input's moves do: it is the drive's own");
    EXPECT_NE(in_step(9.81), "");
    EXPECT_NE(in_step(10.19), "");
    EXPECT_EQ(in_step(9.79), "");
    EXPECT_EQ(in_step(10.21), "");
    EXPECT_EQ(in_step(10.0, "valve_stiction"), "");
}

}  // namespace
