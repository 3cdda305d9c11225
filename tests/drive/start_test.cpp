// Starts of a fit: a plant that lies on the search's grid is found as it is, and the tangent is what its definition
// says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/failure.hpp"
#include "drive/closed_loop.hpp"
#include "drive/controller.hpp"
#include "drive/fit.hpp"

namespace {

using drive::Kind;
using drive::Model;
using drive::Record;

// Half a step of the search's grid between stamps would be found beside it, not on it.
Record even_record(const Model& model, const std::vector<drive::Change>& changes, double step_s, std::size_t points) {
    Record record;
    record.name = "even";
    record.changes = changes;
    for (std::size_t k = 0; k < points; ++k) {
        record.time_s.push_back(static_cast<double>(k) * step_s);
    }
    record.output = drive::respond(model, changes, record.time_s);
    return record;
}

Model swinging(double gain, double time_constant_s, double damping, double delay_s) {
    Model model = drive::make_sopdt(gain, time_constant_s, delay_s);
    model.kind = Kind::fotf;
    model.denominator[1].coefficient *= damping;
    return model;
}

void expect_found(const Model& found, const Model& truth) {
    EXPECT_NEAR(found.gain / truth.gain, 1.0, 1e-6);
    EXPECT_NEAR(found.delay_s, truth.delay_s, 1e-9);
    ASSERT_EQ(found.denominator.size(), truth.denominator.size());
    for (std::size_t i = 0; i < truth.denominator.size(); ++i) {
        EXPECT_NEAR(found.denominator[i].coefficient / truth.denominator[i].coefficient, 1.0, 1e-6) << i;
        EXPECT_EQ(found.denominator[i].order, truth.denominator[i].order);
    }
}

// Time constants from the record's length to 1.2 of 400 steps, each less than the last by a tenth in the logarithm, or
// by the damping where that is less; dead times of each step up to half of the record.
TEST(SearchStart, FindsWhatLiesOnItsGrid) {
    constexpr double length_s = 8.0;
    constexpr double step_s = length_s / 400.0;
    const auto constant_s = [](int i, double apart = 0.1) { return length_s * std::exp(-apart * i); };
    const std::vector<drive::Change> changes{{0.0, 1.0}, {4.0, -1.5}};
    for (const auto& [i, shift] : {std::pair(0, 0), std::pair(20, 5), std::pair(31, 199), std::pair(58, 42)}) {
        const Model first = drive::make_fopdt(-3.0, constant_s(i), shift * step_s);
        expect_found(drive::search_start(Kind::fopdt, {even_record(first, changes, step_s, 401)}), first);
        const Model second = drive::make_sopdt(2.0, constant_s(i), shift * step_s);
        expect_found(drive::search_start(Kind::sopdt, {even_record(second, changes, step_s, 401)}), second);
    }
    for (const double damping : {1.0, 0.5, 0.25, 0.1, 0.05, 0.025}) {
        const double apart = std::min(damping, 0.1);
        const int i = static_cast<int>(std::lround(4.1 / apart));
        const Model swings = swinging(2.0, constant_s(i, apart), damping, 13 * step_s);
        expect_found(drive::search_start(Kind::niopdt, {even_record(swings, changes, step_s, 401)}), swings);
    }
    // The longest record fixes the grid, whichever it is.
    const Model first = drive::make_fopdt(2.0, constant_s(25), 8 * step_s);
    const Record whole = even_record(first, changes, step_s, 401);
    const Record part = even_record(first, {{1.0, 0.5}}, step_s, 101);
    expect_found(drive::search_start(Kind::fopdt, {part, whole}), first);
    // What changes beyond a record's end, or before its beginning, is no reason to look outside.
    Record outside = whole;
    outside.changes.push_back({9.0, 3.0});
    expect_found(drive::search_start(Kind::fopdt, {outside}), first);
    const Model late = drive::make_fopdt(2.0, constant_s(25), 0.6 * length_s);
    EXPECT_LT(drive::search_start(Kind::fopdt, {even_record(late, {{0.0, 1.0}}, step_s, 401)}).delay_s, 0.5 * length_s);
}

// In a loop 12 time constants, 12 dead times that grow as squares up to 0.3 of the record, 16 gains from a fiftieth to
// forty times what undoes the controller's own after a tenth of the record.
TEST(SearchStart, FindsWhatLiesOnItsGridInALoop) {
    const Model controller = drive::to_model({.kp = 0.5, .ki = 0.25}, "controller");
    constexpr double step_s = 0.02;
    constexpr double length_s = 299 * step_s;
    const double answer = 0.5 + 0.25 * 30 * step_s;
    const auto found_of = [&](const Model& truth, Kind kind) {
        Record record;
        record.name = "loop";
        record.controller = controller;
        for (int k = 0; k < 300; ++k) {
            record.time_s.push_back(k * step_s);
            record.reference.push_back(k < 150 ? 1.0 : 0.25);
        }
        record.changes = drive::changes_of(record.time_s, record.reference);
        record.output = drive::run_loop(truth, controller, record.time_s, record.reference, 0.0).output;
        return drive::search_start(kind, {record});
    };
    struct Place {
        Kind kind;
        int constant, delay, gain;
    };
    for (const Place& place :
         {Place{Kind::sopdt, 4, 3, 5}, Place{Kind::fopdt, 0, 0, 15}, Place{Kind::fopdt, 11, 11, 0}}) {
        const double gain = 0.02 / answer * std::pow(2000.0, place.gain / 15.0);
        const double constant_s = length_s * std::pow(0.003, place.constant / 11.0);
        const double delay_s = 0.3 * length_s * place.delay * place.delay / 144.0;
        const Model truth = place.kind == Kind::fopdt ? drive::make_fopdt(gain, constant_s, delay_s)
                                                      : drive::make_sopdt(gain, constant_s, delay_s);
        expect_found(found_of(truth, place.kind), truth);
    }
    // Beyond the grid its last place is the nearest.
    const double last_constant_s = 0.003 * length_s;
    const double last_delay_s = 0.3 * length_s * 121.0 / 144.0;
    const double last_gain = 0.02 / answer * 2000.0;
    const double faster_s = length_s * std::pow(0.003, 12.0 / 11.0);
    EXPECT_NEAR(found_of(drive::make_fopdt(1.0, faster_s, 0.0), Kind::fopdt).denominator[0].coefficient,
                last_constant_s, 1e-9);
    EXPECT_LE(found_of(drive::make_fopdt(0.2, 1.0, 0.3 * length_s), Kind::fopdt).delay_s, last_delay_s + 1e-9);
    EXPECT_LE(found_of(drive::make_fopdt(last_gain * std::pow(2000.0, 1.0 / 15.0), length_s, 0.0), Kind::fopdt).gain,
              last_gain * (1.0 + 1e-9));
}

/// A record whose output is given, behind a step from 0 at `from_s`, which is held to the end.
Record stepped(double from_s, double size, double step_s, std::size_t points,
               const std::function<double(double)>& output) {
    Record record;
    record.name = "stepped";
    record.changes = {{from_s, size}};
    for (std::size_t k = 0; k < points; ++k) {
        record.time_s.push_back(static_cast<double>(k) * step_s);
        record.output.push_back(output(record.time_s.back()));
    }
    return record;
}

std::string refusal_of(const Record& record) {
    try {
        (void)drive::tangent_construction(Kind::fopdt, record);
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "accepted";
}

// A straight rise of 3 in 2 s, 0.5 s after a step of 1.5.
TEST(Tangent, OfAStraightRiseIsTheRise) {
    const Record record =
        stepped(1.0, 1.5, 0.01, 801, [](double t) { return 3.0 * std::clamp((t - 1.5) / 2.0, 0.0, 1.0); });
    const Model first = drive::tangent_construction(Kind::fopdt, record);
    EXPECT_NEAR(first.gain, 2.0, 1e-9);
    EXPECT_NEAR(first.denominator[0].coefficient, 2.0, 1e-9);
    EXPECT_NEAR(first.delay_s, 0.5, 1e-9);
    const Model second = drive::tangent_construction(Kind::sopdt, record);
    const double e = std::exp(1.0);
    EXPECT_NEAR(second.denominator[1].coefficient, 2.0 * 2.0 / e, 1e-9);
    EXPECT_NEAR(second.delay_s, 0.5 - (3.0 - e) * 2.0 / e, 1e-9);
    // A rise that begins at once has no dead time, however far the tangent reaches before the step.
    const Record at_once =
        stepped(1.0, 1.0, 0.01, 801, [](double t) { return t < 1.0 ? 0.0 : std::min(1.0, 0.3 + 0.5 * (t - 1.0)); });
    EXPECT_EQ(drive::tangent_construction(Kind::fopdt, at_once).delay_s, 0.0);
    EXPECT_EQ(drive::tangent_construction(Kind::sopdt, at_once).delay_s, 0.0);
    // Falling is rising the other way.
    Record falling = record;
    for (double& value : falling.output) {
        value = 1.0 - value;
    }
    EXPECT_NEAR(drive::tangent_construction(Kind::fopdt, falling).gain, -2.0, 1e-9);
    EXPECT_NEAR(drive::tangent_construction(Kind::fopdt, falling).delay_s, 0.5, 1e-9);
}

// y = x - x^3/3 from -1 to 1: the line through 2 m + 1 samples about its middle has the slope 1 - h^2 (3 m^2 + 3 m - 1)
// / 15, m a 24th of what lies between a tenth and nine tenths of the rise.
TEST(Tangent, IsALineThroughATwelfthOfTheRise) {
    constexpr double h = 0.0005;
    const auto y = [](double x) { return x - x * x * x / 3.0; };
    const Record record =
        stepped(0.0, 1.0, h, 8001, [&](double t) { return y(std::clamp(t - 1.5, -1.0, 1.0)) + 2.0 / 3.0; });
    int between = 0;
    for (int k = 0; k <= 4000; ++k) {
        const double part = 0.75 * (y(k * h - 1.0) + 2.0 / 3.0);
        between += part >= 0.1 && part < 0.9 ? 1 : 0;
    }
    const double m = between / 24;
    const double slope = 1.0 - h * h * (3.0 * m * m + 3.0 * m - 1.0) / 15.0;
    const Model found = drive::tangent_construction(Kind::fopdt, record);
    EXPECT_NEAR(found.gain, 4.0 / 3.0, 1e-9);
    EXPECT_NEAR(found.denominator[0].coefficient, 4.0 / 3.0 / slope, 1e-6);
}

// Before the step its last sample too, and of what is held the sample at its end too, of which the last tenth is the
// new level.
TEST(Tangent, TakesTheLevelsBeforeAndAfter) {
    Record record = stepped(0.5, 2.0, 0.1, 60, [](double t) { return std::clamp(t - 0.6, 0.0, 2.0) + 0.1; });
    record.changes.push_back({4.5, -1.0});
    record.output[5] = 0.7;   // at the step: the level before is the mean of 0.1, five times, and of 0.7
    record.output[45] = 3.1;  // at its end: the level after, the mean of 2.1, four times, and of 3.1
    for (std::size_t k = 46; k < 60; ++k) {
        record.output[k] = 50.0;
    }
    EXPECT_NEAR(drive::tangent_construction(Kind::fopdt, record).gain, (2.3 - 0.2) / 2.0, 1e-12);
    // Of 100 samples the last ten.
    Record longer = stepped(0.0, 1.0, 0.1, 100, [](double t) { return std::clamp(t - 0.6, 0.0, 2.0); });
    longer.output[90] = 3.0;
    EXPECT_NEAR(drive::tangent_construction(Kind::fopdt, longer).gain, 2.1, 1e-12);
    longer.output[90] = 2.0;
    longer.output[89] = 2.5;
    EXPECT_NEAR(drive::tangent_construction(Kind::fopdt, longer).gain, 2.0, 1e-12);
}

TEST(Tangent, WantsTwentySamplesAndALevelThatSettles) {
    const auto rise = [](double t) { return std::clamp(2.0 * (t - 0.1), 0.0, 1.0); };
    EXPECT_EQ(refusal_of(stepped(0.0, 1.0, 0.1, 20, rise)), "accepted");
    EXPECT_NE(refusal_of(stepped(0.0, 1.0, 0.1, 19, rise)).find("at least 20 samples"), std::string::npos);
    // Between the last two tenths a tenth of the rise is settled, and more is not.
    const auto creeping = [](double by) {
        return stepped(0.0, 1.0, 0.1, 100,
                       [by](double t) { return t > 8.95 ? 1.0 : std::min(1.0 - by, 0.5 * std::max(0.0, t - 0.5)); });
    };
    EXPECT_EQ(refusal_of(creeping(0.0995)), "accepted");
    EXPECT_NE(refusal_of(creeping(0.1005)).find("that settles"), std::string::npos);
    EXPECT_EQ(refusal_of(creeping(-0.0995)), "accepted");
    EXPECT_NE(refusal_of(creeping(-0.1005)).find("that settles"), std::string::npos);
    EXPECT_NE(refusal_of(stepped(0.0, 1.0, 0.1, 100, [](double) { return 0.5; })).find("that settles"),
              std::string::npos);
    Record looped = stepped(0.0, 1.0, 0.1, 100, rise);
    looped.controller = drive::to_model({.kp = 1.0}, "controller");
    EXPECT_NE(refusal_of(looped).find("open loop"), std::string::npos);
}

}  // namespace
