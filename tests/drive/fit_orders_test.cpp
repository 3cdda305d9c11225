// An order that runs away to the bound of its form is held to 2, wherever it stands among what is free.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drive/fit.hpp"
#include "drive/response.hpp"
#include "plants.hpp"

namespace {

// All else is known, so that the order is the first of what is free, and the last.
TEST(FitOrders, AreHeldToTwoWhereNothingElseIsFree) {
    drive::Model beyond = plants::niopdt();
    beyond.denominator[0].order = 2.8;
    beyond.delay_s = 0.0;
    drive::Record record;
    record.name = "step";
    record.changes = {{0.0, 1.0}};
    for (int k = 0; k < 60; ++k) {
        record.time_s.push_back(0.05 * k);
    }
    record.output = drive::respond(beyond, record.changes, record.time_s);
    drive::Model begin = beyond;
    begin.denominator[0].order = 2.0;
    drive::Form form(drive::Kind::niopdt, begin);
    for (drive::Parameter& parameter : form.parameters()) {
        parameter.fixed = parameter.name != "alpha2";
    }
    const drive::Fit held = drive::fit(form, {record}, {});
    EXPECT_DOUBLE_EQ(held.model.denominator[0].order, 2.0);
    EXPECT_THAT(held.warnings, testing::Contains(testing::HasSubstr("orders beyond 2")));
    form.parameter("alpha2").bounds_are_given = true;
    const drive::Fit free = drive::fit(form, {record}, {});
    EXPECT_DOUBLE_EQ(free.model.denominator[0].order, 2.5);
    EXPECT_THAT(free.warnings, testing::Not(testing::Contains(testing::HasSubstr("orders beyond 2"))));
}

// What a model is stepped by is no number to be fitted: it goes with it, whatever its form.
TEST(FitForms, KeepTheSampleTime) {
    drive::Model start = plants::sopdt();
    start.sample_time_s = 0.25;
    for (const drive::Kind kind : {drive::Kind::fopdt, drive::Kind::sopdt, drive::Kind::niopdt, drive::Kind::fotf}) {
        const drive::Form form(kind, start);
        EXPECT_EQ(form.to_model(form.values()).sample_time_s, 0.25);
    }
    start.sample_time_s.reset();
    const drive::Form form(drive::Kind::fopdt, start);
    EXPECT_FALSE(form.to_model(form.values()).sample_time_s);
}

}  // namespace
