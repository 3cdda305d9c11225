// Parts of a base that is looked for: filtered equations, two modes, structures, signs that were lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "gap/drive/base/filtered.hpp"
#include "gap/drive/base/find.hpp"
#include "gap/drive/base/modes.hpp"
#include "gap/drive/base/signs.hpp"
#include "gap/drive/base/structure.hpp"
#include "gap/drive/candidate.hpp"
#include "gap/drive/start.hpp"
#include "made_records.hpp"

namespace {

using gap_test::h;
using gap_test::levels;
using gap_test::of;
using gap_test::record_of;
using gap_test::response;
using testing::ElementsAre;

// A log that begins in motion does not say what was put in before it: its first level, or nothing.
TEST(InMotion, BeginsWithItsFirstLevelOrWithNothing) {
    gap::Record record = record_of(401, [](double t) { return levels(t + 6.0); });
    ASSERT_EQ(record.input.front(), 1.0);
    record.output = response(record, of({{2.0, 1.0}, {1.0, 0.0}}));
    gap::Question question{{drive::Kind::fopdt, drive::make_fopdt(1.0, 2.0, 0.5)},
                           true,
                           {record},
                           {record},
                           {},
                           gap::Metric::simulation,
                           {},
                           1};
    const auto begins_at = [&](bool from_no_input) {
        question.from_no_input = from_no_input;
        const gap::Ground ground = gap::prepare(question);
        double value = -1.0;
        for (const gap::FreeParameter& number : gap::state_of(ground.study, record)) {
            value = number.name == "input_before" ? number.value : value;
        }
        return value;
    };
    EXPECT_EQ(begins_at(false), 1.0);
    EXPECT_EQ(begins_at(true), 0.0);
}

// A base is looked for from both. Here, too, the plant was at rest until the log began, and its dead time is long.
TEST(InMotion, IsLookedForFromBoth) {
    const auto late = [](double shift) {
        gap::Record record = record_of(401, [&](double t) { return levels(t + shift); });
        drive::Model model = of({{2.0, 1.0}, {1.0, 0.0}});
        model.delay_s = 8.0;
        record.output = response(record, model);
        for (std::size_t i = 0; i < record.size(); ++i) {
            record.output[i] += 1e-3 * std::sin(37.0 * static_cast<double>(i));
        }
        return record;
    };
    const auto from_nothing = [&](double shift) {
        const gap::Question question{
            gap::form_to_find(), false, {late(shift)}, {late(21.0)}, {}, gap::Metric::simulation, {}, 1};
        return std::ranges::count_if(gap::find_base(question, [](const std::string&) {}),
                                     [](const gap::Described& one) { return one.from_no_input; });
    };
    EXPECT_GE(from_nothing(6.0), 1);
    EXPECT_EQ(from_nothing(0.0), 0);  // at rest there is no other
}

// --- Filtered equations.

// y' = (3 u - y) / 2 from 1.5, read with an offset of 10; exact between samples. u is late by so many of them.
gap::Record lagging(std::size_t late) {
    gap::Record record = record_of(401, levels);
    double y = 1.5;
    const double left = std::exp(-h / 2.0);
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.output[i] = 10.0 + y;
        y = y * left + 3.0 * (i < late ? 0.0 : record.input[i - late]) * (1.0 - left);
    }
    return record;
}

// Of nine dead times, 0 and from a sample to a fifth of the record, under each of seven filters.
TEST(FilteredEstimates, TryNineDeadTimesUnderSevenFilters) {
    std::map<long, std::size_t> found;  // by nanoseconds: those that have a solution
    for (const std::size_t late : {0U, 7U, 20U, 40U}) {
        for (const gap::Coefficients& one :
             gap::filtered_estimates(*gap::structure_named("first_order"), {lagging(late)}, true)) {
            ASSERT_EQ(one.denominator.size(), 1U);
            EXPECT_GT(one.denominator[0], 0.0);
            found[std::lround(1e9 * one.delay_s)] += late == 7 ? 1U : 0U;
        }
    }
    std::vector<long> wanted{0};
    for (int d = 0; d < 8; ++d) {
        wanted.push_back(std::lround(1e9 * h * std::pow(0.2 * 100.0 / h, d / 7.0)));
    }
    std::vector<long> delays;
    for (const auto& [delay, times] : found) {
        delays.push_back(delay);
    }
    EXPECT_EQ(delays, wanted);
    EXPECT_EQ(found[0], 7U);
    EXPECT_EQ(found[wanted[5]], 7U);
    // Without an input there is no dead time, and the gain stays.
    gap::Record free = record_of(401, [](double) { return 0.0; });
    for (std::size_t i = 0; i < free.size(); ++i) {
        free.output[i] = 0.5 + 3.0 * std::exp(-free.time_s[i] / 4.0);
    }
    const auto starts = gap::filtered_estimates(*gap::structure_named("first_order"), {free}, false);
    EXPECT_EQ(starts.size(), 7U);
    for (const gap::Coefficients& one : starts) {
        EXPECT_EQ(one.gain, 1.0);
        EXPECT_EQ(one.delay_s, 0.0);
        EXPECT_NEAR(one.denominator.at(0), 4.0, 0.02);
    }
    // What stays where it is has no lag.
    gap::Record still = free;
    std::ranges::fill(still.output, 0.0);
    EXPECT_THAT(gap::filtered_estimates(*gap::structure_named("first_order"), {still}, false), testing::IsEmpty());
}

// Of a record without noise the equation holds under every filter, whatever was before the record.
TEST(FilteredEstimates, AreTheCoefficientsOfTheEquation) {
    std::size_t near = 0;
    for (const gap::Coefficients& one :
         gap::filtered_estimates(*gap::structure_named("first_order"), {lagging(7)}, true)) {
        near += std::lround(one.delay_s / h) == 7 && std::fabs(one.gain - 3.0) < 0.001 &&
                std::fabs(one.denominator[0] - 2.0) < 0.01;
    }
    EXPECT_EQ(near, 7U);
    // A position: 1 / (s (1 + 2 s)), and a constant force.
    gap::Record second = record_of(401, levels);
    const double left = std::exp(-h / 2.0);
    double speed = 0.0;
    double place = 0.0;
    for (std::size_t i = 0; i < second.size(); ++i) {
        second.output[i] = place;
        const double force = 3.0 * second.input[i] + 0.4;
        place += force * h + (speed - force) * 2.0 * (1.0 - left);
        speed = speed * left + force * (1.0 - left);
    }
    near = 0;
    for (const gap::Coefficients& one :
         gap::filtered_estimates(*gap::structure_named("integrator_lag"), {second}, true)) {
        near += one.delay_s == 0.0 && std::fabs(one.gain - 3.0) < 0.005 && std::fabs(one.denominator[0] - 2.0) < 0.004;
    }
    EXPECT_EQ(near, 7U);
    // A lead: (1 + 5 s) / (1 + 2 s)^2 is what both states of a chain make.
    gap::Record third = record_of(401, levels);
    double a = 0.0;
    double b = 0.0;
    for (std::size_t i = 0; i < third.size(); ++i) {
        third.output[i] = b + 5.0 * (a - b) / 2.0;
        const double u = third.input[i];
        const double next = u + (b - u + (a - u) * h / 2.0) * left;
        a = u + (a - u) * left;
        b = next;
    }
    near = 0;
    for (const gap::Coefficients& one :
         gap::filtered_estimates(*gap::structure_named("second_order_zero"), {third}, true)) {
        near += one.delay_s == 0.0 && std::fabs(one.gain - 1.0) < 0.003 && std::fabs(one.numerator[0] - 5.0) < 0.06 &&
                std::fabs(one.denominator[0] - 4.0) < 0.03 && std::fabs(one.denominator[1] - 4.0) < 0.03;
    }
    EXPECT_EQ(near, 3U);  // under the slowest three; what a quick filter passes between samples is no straight line
}

// --- Two modes.

// Of 1 s decay and 2 rad/s; and a second one.
gap::Described modes(double aside, double validation, double decay_s) {
    const auto times = [](double decay, double rad_per_s) {
        const double squared = rad_per_s * rad_per_s + 1.0 / (decay * decay);
        return std::pair{2.0 / decay / squared, 1.0 / squared};  // a1 and a2
    };
    const auto [b1, b2] = times(1.0, 2.0);
    const auto [c1, c2] = times(decay_s, 9.0);
    const gap::Structure& structure = *gap::structure_named("two_modes");
    const gap::Coefficients at{.denominator = {b1 + c1, b2 + c2 + b1 * c1, b1 * c2 + b2 * c1, b2 * c2},
                               .numerator = {0.0, 0.0}};
    return {structure.name,
            structure.meaning,
            gap::form_of(structure, at, true),
            aside,
            validation,
            structure.numbers(),
            0};
}

TEST(TwoModes, AreThePlantsOwnOrNone) {
    const gap::Structure& one = *gap::structure_named("second_order");
    const gap::Described other{one.name, one.meaning, gap::form_to_find(), 0.2, 0.3, one.numbers(), 0};
    const auto left = [&](const gap::Described& two) {
        std::vector<gap::Described> found = {other, two};
        gap::keep_own_modes(found, 30.0);
        return found.size();
    };
    EXPECT_EQ(left(modes(0.099, 0.149, 3.0)), 2U);
    EXPECT_EQ(left(modes(0.101, 0.149, 3.0)), 1U);  // half of what one leaves
    EXPECT_EQ(left(modes(0.099, 0.151, 3.0)), 1U);
    EXPECT_EQ(left(modes(0.1, 0.149, 3.0)), 1U);  // less than half
    EXPECT_EQ(left(modes(0.099, 0.15, 3.0)), 1U);
    EXPECT_EQ(left(modes(0.099, 0.149, 9.9)), 2U);  // a third of the record
    EXPECT_EQ(left(modes(0.099, 0.149, 10.1)), 1U);
    EXPECT_EQ(left(modes(0.099, 0.149, -3.0)), 1U);  // it grows
}

// --- Structures.

// By its roots: -1 / lag, and two whose product is 1 / period^2 and whose sum is -2 damping / period.
TEST(Structures, OfALagAndAnOscillator) {
    constexpr double lag_s = 0.8;
    constexpr double period_s = 0.3;
    constexpr double damping = 0.25;
    const gap::Coefficients found = gap::lag_and_oscillator(lag_s, period_s, damping, 0.4);
    ASSERT_EQ(found.denominator.size(), 3U);
    EXPECT_EQ(found.gain, 1.0);
    EXPECT_EQ(found.delay_s, 0.4);
    const std::complex<double> swinging = std::polar(1.0 / period_s, std::acos(-damping));
    for (const std::complex<double> root : {std::complex<double>(-1.0 / lag_s), swinging, std::conj(swinging)}) {
        std::complex<double> sum = 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            sum += found.denominator[i] * std::pow(root, static_cast<double>(i + 1));
        }
        EXPECT_LT(std::abs(sum), 1e-12) << root;
    }
}

TEST(Structures, HaveTheirNumbers) {
    const auto numbers = [](const char* name) { return gap::structure_named(name)->numbers(); };
    EXPECT_EQ(numbers("first_order"), 2);
    EXPECT_EQ(numbers("fractional_lag"), 3);
    EXPECT_EQ(numbers("pure_integrator"), 1);
    EXPECT_EQ(numbers("double_integrator"), 1);
    EXPECT_EQ(numbers("second_order"), 3);
    EXPECT_EQ(numbers("fractional_second_order"), 5);
    EXPECT_EQ(numbers("integrator_lag"), 2);
    EXPECT_EQ(numbers("second_order_zero"), 4);
    EXPECT_EQ(numbers("third_order"), 4);
    EXPECT_EQ(numbers("integrator_second_order"), 3);
    EXPECT_EQ(numbers("third_order_zero"), 5);
    EXPECT_EQ(numbers("two_modes"), 7);
    EXPECT_EQ(gap::structures().size(), 12U);
}

// gain (1 + 5 s) / (s (1 + 2 s)): whole orders stay, and what stands before the lowest power.
TEST(Structures, AreFormsWhoseFreeNumbersAreTheirs) {
    const gap::Structure structure{"", 2, 1, 1, ""};
    const auto free = [](const drive::Form& form) {
        std::vector<std::string> names;
        for (const drive::Parameter& parameter : form.parameters()) {
            if (!parameter.fixed) {
                names.push_back(parameter.name);
            }
        }
        return names;
    };
    const gap::Coefficients at{3.0, {2.0}, {5.0}, 0.5};
    drive::Form driven = gap::form_of(structure, at, true);
    EXPECT_THAT(free(driven), testing::UnorderedElementsAre("gain", "b1", "a1", "delay_s"));
    EXPECT_EQ(driven.parameter("a1").lower, 0.0);
    EXPECT_LT(driven.parameter("b1").lower, 0.0);
    const drive::Model model = gap::model_of(driven);
    EXPECT_EQ(model.gain, 3.0);
    EXPECT_EQ(model.delay_s, 0.5);
    const std::complex<double> s(0.3, 0.7);
    EXPECT_LT(std::abs(drive::evaluate_without_delay(model, s) - 3.0 * (1.0 + 5.0 * s) / (s * (1.0 + 2.0 * s))), 1e-12);
    const drive::Form free_motion = gap::form_of({"", 2, 0, 0, ""}, {3.0, {2.0, 4.0}, {}, 0.5}, false);
    EXPECT_THAT(free(free_motion), testing::UnorderedElementsAre("a1", "a2"));
    EXPECT_EQ(gap::model_of(free_motion).gain, 1.0);
    EXPECT_EQ(gap::model_of(free_motion).delay_s, 0.0);
}

// --- Signs.

// Never below a twentieth of the span, of an input of two signs.
TEST(LostSigns, MayBeWhereReadingsStayAbove) {
    const auto may = [](double lowest, double low_input) {
        gap::Record record = record_of(40, [=](double t) { return t < 4.0 ? 1.0 : low_input; });
        record.output[3] = 1.0;
        record.output[30] = lowest;
        return gap::may_have_lost_signs({record});
    };
    EXPECT_TRUE(may(0.2, -1.0));
    EXPECT_TRUE(may(-0.0520, -1.0));  // of a span of 1.052
    EXPECT_FALSE(may(-0.0532, -1.0));
    EXPECT_FALSE(may(0.2, 0.0));
    gap::Record at_the_limit = record_of(40, [](double t) { return t < 4.0 ? 1.0 : -1.0; });
    at_the_limit.output.assign(40, 0.95);
    at_the_limit.output[30] = -0.05;  // a twentieth of a span of 1
    EXPECT_FALSE(gap::may_have_lost_signs({at_the_limit}));
    gap::Record below = record_of(40, [](double t) { return t < 4.0 ? 0.0 : -1.0; });
    below.output[3] = 1.0;
    EXPECT_FALSE(gap::may_have_lost_signs({below}));
}

// After each change of the input's sign the readings have it from where they first turn; a rest has the last one's.
TEST(LostSigns, BeginWhereReadingsTurn) {
    gap::Record record;
    record.input = {0, 1, 1, 1, 1, -1, -1, -1, -1, -1, 0, 0, 2, 2, 2};
    record.output = {0, 2, 4, 4, 4, 3, 1, 0.1, 2, 4, 3, 2, 1, 0.15, 2};
    record.time_s.assign(15, 0.0);
    EXPECT_THAT(gap::with_signs({record})[0].output,
                ElementsAre(0, 2, 4, 4, 4, 3, 1, -0.1, -2, -4, -3, -2, -1, 0.15, 2));
    // Within a twentieth of the highest a rise is no turn: 0.2 here.
    record.output = {0, 2, 4, 4, 4, 3, 1, 1.19, 0.5, 4, 3, 2, 1, 0.15, 2};
    EXPECT_THAT(gap::with_signs({record})[0].output,
                ElementsAre(0, 2, 4, 4, 4, 3, 1, 1.19, -0.5, -4, -3, -2, -1, 0.15, 2));
    record.output[7] = 1.21;
    EXPECT_THAT(gap::with_signs({record})[0].output,
                ElementsAre(0, 2, 4, 4, 4, 3, -1, -1.21, -0.5, -4, -3, -2, -1, 0.15, 2));
    // One that begins downwards was there before.
    record.input.assign(15, -1.0);
    record.output[0] = 1.0;
    EXPECT_EQ(gap::with_signs({record})[0].output[0], -1.0);
    EXPECT_EQ(gap::with_signs({record})[0].output[2], -4.0);
}

// What swings passes 0 without a change of the input: no sign of that tells where, a base that was fitted does, of what
// judges too.
TEST(LostSigns, AreThoseOfABaseWherePlantsSwing) {
    // (1 + 0.3 s)(1 + 0.4 s + 0.7 s^2)
    const drive::Model model = of({{0.21, 3.0}, {0.82, 2.0}, {0.7, 1.0}, {1.0, 0.0}});
    const auto swinging = [&](double sign) {
        gap::Record record = record_of(240, [sign](double t) { return sign * levels(t); });
        record.output = response(record, model);
        return record;
    };
    const gap::Record train = swinging(1.0);
    const gap::Record judge = swinging(-1.0);
    gap::Question question{{drive::Kind::fopdt, drive::make_fopdt(1.0, 2.0, 0.5)},
                           false,
                           {train},
                           {judge},
                           {},
                           gap::Metric::simulation,
                           {},
                           1};
    for (gap::Record* record : {&question.train[0], &question.validate[0]}) {
        std::ranges::transform(record->output, record->output.begin(), [](double y) { return std::fabs(y); });
    }
    const auto wrong = [](const gap::Record& found, const gap::Record& truth) {
        int count = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            EXPECT_EQ(std::fabs(found.output[i]), std::fabs(truth.output[i]));
            count += found.output[i] * truth.output[i] < 0.0 && std::fabs(truth.output[i]) > 0.01 ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(wrong(gap::with_signs(question.train)[0], train), 10);
    EXPECT_GT(wrong(gap::with_signs(question.validate)[0], judge), 10);
    const gap::Question found = gap::with_signs_of_a_base(question);
    EXPECT_TRUE(found.refit);
    EXPECT_EQ(wrong(found.train[0], train), 0);
    EXPECT_EQ(wrong(found.validate[0], judge), 0);
}

// One that swings at every move of the input is somewhere else by the time the input turns: nothing of that tells its
// signs, the magnitudes themselves do. The plant of two motors and a belt, an interval of 20 ms.
TEST(LostSigns, AreThoseOfTheMagnitudesWhereNoTurnTellsThem) {
    constexpr double ms = h / 20.0;
    constexpr double lag = 130.0 * ms;
    constexpr double swing = 46.5 * ms;
    constexpr double damping = 0.15;
    const drive::Model model = of({{lag * swing * swing, 3.0},
                                   {swing * swing + 2.0 * damping * swing * lag, 2.0},
                                   {lag + 2.0 * damping * swing, 1.0},
                                   {1.0, 0.0}});
    const auto swinging = [&](unsigned seed) {
        gap::Record record = record_of(500, [bits = seed](double t) mutable {
            return (bits >> (static_cast<unsigned>(t / (100.0 * ms) + 0.5) % 31U)) % 2U == 0U ? 1.0 : -1.0;
        });
        record.output = response(record, model);
        return record;
    };
    const gap::Record truth = swinging(0x5A3C96E1U);
    gap::Question question{{drive::Kind::fopdt, drive::make_fopdt(1.0, 2.0, 0.5)},
                           false,
                           {truth},
                           {},
                           0.75 * truth.time_s.back(),
                           gap::Metric::simulation,
                           {},
                           1};
    std::ranges::transform(truth.output, question.train[0].output.begin(), [](double y) { return std::fabs(y); });
    const auto wrong = [&](const gap::Record& found) {
        int count = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            count += found.output[i] * truth.output[i] < 0.0 && std::fabs(truth.output[i]) > 0.1 ? 1 : 0;
        }
        return std::min(count, static_cast<int>(truth.size()) - count);
    };
    EXPECT_GT(wrong(gap::with_signs(question.train)[0]), 50);
    EXPECT_EQ(wrong(gap::with_signs_of_a_base(question).train[0]), 0);
}

}  // namespace
