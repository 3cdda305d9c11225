// Starts of a fit at their edges: which samples and changes a search's grid takes, and through which samples the
// tangent goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "drive/controller.hpp"
#include "drive/fit.hpp"
#include "tests/drive/refused.hpp"

namespace {

using drive::Change;
using drive::Kind;
using drive::Model;
using drive::Record;
using test::refusal_of;

// The steps of a search's grid are those of an even log of 401 to 4001 samples: these are exact in binary.
constexpr double step_s = 1.0 / 64.0;
constexpr double length_s = 400.0 * step_s;
const double constant_s = std::exp(-2.5) * length_s;
const Model truth = drive::make_fopdt(2.0, constant_s, 8.0 * step_s);

Record even_record(const std::vector<Change>& changes, int steps = 400, const Model& model = truth) {
    Record record;
    record.name = "even";
    record.changes = changes;
    for (int k = 0; k <= steps; ++k) {
        record.time_s.push_back(k * step_s);
    }
    record.output = drive::respond(model, changes, record.time_s);
    return record;
}

Model found_of(const Record& record) { return drive::search_start(Kind::fopdt, {record}); }

void expect_truth(const Record& record, const Model& model = truth) {
    const Model found = found_of(record);
    EXPECT_NEAR(found.gain / model.gain, 1.0, 1e-6);
    EXPECT_NEAR(found.denominator[0].coefficient / model.denominator[0].coefficient, 1.0, 1e-6);
    EXPECT_NEAR(found.delay_s, model.delay_s, 1e-9);
}

// A billionth of a step is rounding; what comes later is of the next point.
TEST(SearchStartEdges, ASampleCountsFromABillionthOfAStepBeforeItsStampOn) {
    const Record record = even_record({{0.0, 1.0}});
    const auto late_by = [&](double steps) {
        Record late = record;
        for (std::size_t k = 1; k + 1 < late.time_s.size(); ++k) {  // its length fixes the grid
            late.time_s[k] += steps * step_s;
        }
        return found_of(late).gain;
    };
    EXPECT_EQ(late_by(0.995e-9), found_of(record).gain);
    EXPECT_NE(late_by(1.005e-9), found_of(record).gain);
}

// Of a log whose stamps are denser than the grid the last one before a point counts.
TEST(SearchStartEdges, OfSeveralSamplesTheLastCounts) {
    constexpr int steps = 4000;  // as many as there are
    const Model model = drive::make_fopdt(2.0, std::exp(-2.5) * steps * step_s, 8.0 * step_s);
    Record dense = even_record({{0.0, 1.0}}, steps, model);
    for (std::size_t k = steps; k > 0; --k) {
        const auto at = static_cast<std::ptrdiff_t>(k);
        dense.time_s.insert(dense.time_s.begin() + at, (static_cast<double>(k) - 0.25) * step_s);
        dense.output.insert(dense.output.begin() + at, 77.0);
    }
    expect_truth(dense, model);
}

TEST(SearchStartEdges, AChangeIsOfTheNearestPoint) {
    const auto moved = [](double to_steps, double from_steps) {
        Record record = even_record({{to_steps * step_s, 1.0}});
        record.changes[0].time_s = from_steps * step_s;
        return record;
    };
    expect_truth(moved(40.0, 40.49));
    expect_truth(moved(40.0, 39.51));
    expect_truth(moved(41.0, 40.51));
    expect_truth(moved(0.0, -30.0));  // before the record is at its beginning
    // Changes at one point add up.
    Record twice = even_record({{0.0, 1.0}, {40.0 * step_s, -1.5}});
    twice.changes = {{0.0, 0.25}, {0.0, 0.75}, {39.9 * step_s, -0.5}, {40.1 * step_s, -1.0}};
    expect_truth(twice);
}

TEST(SearchStartEdges, AnOutputThatDoesNotFollowHasNoStart) {
    Record still = even_record({{0.0, 1.0}});
    std::fill(still.output.begin(), still.output.end(), 0.0);
    EXPECT_EQ(refusal_of([&] { (void)found_of(still); }),
              "no start found: the output does not follow the input at all");
    Record alone = even_record({{0.0, 1.0}});
    alone.changes.clear();
    EXPECT_EQ(refusal_of([&] { (void)found_of(alone); }),
              "no start found: the output does not follow the input at all");
}

// A controller that has answered nothing after a tenth of the record gives no scale for the gains.
TEST(SearchStartEdges, AControllerHasToAnswerWithinATenthOfTheRecord) {
    Record loop = even_record({{0.0, 1.0}});
    loop.reference.assign(loop.time_s.size(), 1.0);
    loop.controller = drive::to_model({.kp = 1.0}, "controller");
    loop.controller->delay_s = 0.11 * length_s;
    EXPECT_EQ(refusal_of([&] { (void)found_of(loop); }),
              "no start found: the controller does not answer; expected --start MODEL.json");
}

// A record of a step of 2 at its beginning, 0.125 s apart.
Record stepped(const std::vector<double>& output) {
    Record record;
    record.name = "stepped";
    record.changes = {{0.0, 2.0}};
    for (std::size_t k = 0; k < output.size(); ++k) {
        record.time_s.push_back(0.125 * static_cast<double>(k));
    }
    record.output = output;
    return record;
}

// A quick rise: 0, 0.1, 0.4, 0.7, 0.9 have the slope (0.7 - 0.1 + 2 * 0.9) / 10 a sample, and no other five are as
// steep. Their mean, 0.42, is that of the tangent in their middle, which began 1.75 samples before.
TEST(TangentEdges, GoesThroughFiveSamplesAtLeast) {
    std::vector<double> output(40, 1.0);
    std::fill(output.begin(), output.begin() + 10, 0.0);
    const std::vector<double> rise = {0.1, 0.4, 0.7, 0.9};
    std::copy(rise.begin(), rise.end(), output.begin() + 10);
    for (const double sign : {1.0, -1.0}) {
        std::vector<double> either = output;
        for (double& value : either) {
            value *= sign;
        }
        const Model first = drive::tangent_construction(Kind::fopdt, stepped(either));
        EXPECT_NEAR(first.gain, 0.5 * sign, 1e-12);
        EXPECT_NEAR(first.denominator[0].coefficient, 0.125 / 0.24, 1e-12);
        EXPECT_NEAR(first.delay_s, (11.0 - 1.75) * 0.125, 1e-12);
        // Kuepfmueller's: T = rise / e, of which the tangent takes (3 - e) T for itself.
        const Model second = drive::tangent_construction(Kind::sopdt, stepped(either));
        const double second_s = 0.125 / 0.24 / std::exp(1.0);
        EXPECT_NEAR(second.denominator[0].coefficient, second_s * second_s, 1e-12);
        EXPECT_NEAR(second.denominator[1].coefficient, 2.0 * second_s, 1e-12);
        EXPECT_NEAR(second.delay_s, (11.0 - 1.75) * 0.125 - (3.0 - std::exp(1.0)) * second_s, 1e-12);
    }
}

// The slope per sample of the straight line through 2 m + 1 samples from `first` on.
double slope_of(const std::vector<double>& y, std::size_t first, std::size_t m) {
    double product = 0.0;
    double square = 0.0;
    for (std::size_t k = 0; k <= 2 * m; ++k) {
        const double place = static_cast<double>(k) - static_cast<double>(m);
        product += place * y[first + k];
        square += place * place;
    }
    return product / square;
}

// What is steepest at once: 1 - q^k, through the samples from the first on. A tenth to nine tenths of the rise are 120
// samples, and 143. Of either a 24th is 5, on each side of the middle. A level before tells nothing.
TEST(TangentEdges, BeginsWithTheFirstSample) {
    for (const double between : {119.7, 142.7}) {  // 2 ln(3) / ln(1 / q) as it is, from point to point
        const double q = std::exp(-2.0 * std::log(3.0) / between);
        for (const double level : {0.0, 5.0, -3.0}) {
            Record record;
            record.name = "exponential";
            record.changes = {{1.0, 1.0}};
            std::vector<double> after;
            for (int k = -8; k <= 1600; ++k) {
                record.time_s.push_back(1.0 + 0.125 * k);
                record.output.push_back(level + (k < 0 ? 0.0 : 1.0 - std::pow(q, k)));
                if (k >= 0) {
                    after.push_back(record.output.back());
                }
            }
            const Model found = drive::tangent_construction(Kind::fopdt, record);
            EXPECT_NEAR(found.gain, 1.0, 1e-6);
            EXPECT_NEAR(found.denominator[0].coefficient, 0.125 / slope_of(after, 0, 5), 1e-5) << level;
        }
    }
}

}  // namespace
