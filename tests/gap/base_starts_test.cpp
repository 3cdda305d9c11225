// Where the search for a base begins: what linear least squares leave, starts on records that one of them made, forms
// that are asked for by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "gap/drive/base/find.hpp"
#include "gap/drive/base/leftover.hpp"
#include "gap/drive/base/structure.hpp"
#include "gap/drive/start.hpp"
#include "made_records.hpp"

namespace {

using gap_test::courses_of;
using gap_test::h;
using gap_test::levels;
using gap_test::of;
using gap_test::record_of;
using gap_test::response;
using Values = std::vector<double>;

// Each record has its own offset and initial state, or a force where it rests nowhere; the gain is of all.
TEST(Leftover, IsNothingOfWhatIsLinear) {
    const drive::Model lag = of({{2.0, 1.0}, {1.0, 0.0}});
    const drive::Model swing = of({{1.5, 2.0}, {0.6, 1.0}, {1.0, 0.0}});
    const drive::Model integrator = of({{0.8, 2.0}, {1.0, 1.0}});
    for (const drive::Model& model : {lag, swing, integrator}) {
        const bool rests = drive::constant_coefficient(model.denominator) != 0.0;
        const bool moves = drive::highest_order(model.denominator) > 1.0;
        std::vector<gap::Record> records{record_of(200, levels),
                                         record_of(120, [](double t) { return levels(t + 12.0); })};
        double own = 0.7;
        for (gap::Record& record : records) {
            drive::Model driven = model;
            driven.gain = 3.0;
            record.output = response(record, driven, own, moves ? 0.5 * own : 0.0, rests ? 0.0 : 0.1 * own);
            for (double& z : record.output) {
                z += rests ? 2.0 * own : 0.0;
            }
            own = -0.4;
        }
        const gap::Leftover left = gap::leftover_of(model, courses_of(records), true);
        EXPECT_LT(left.squares, 1e-16) << drive::to_text(model);
        EXPECT_NEAR(left.gain, 3.0, 1e-9) << drive::to_text(model);
        // Beside a wave that nothing linear makes, as much as of it.
        for (std::size_t i = 0; i < records[0].size(); ++i) {
            records[0].output[i] += i % 2 == 0 ? 0.01 : -0.01;
        }
        EXPECT_NEAR(gap::leftover_of(model, courses_of(records), true).squares, 200.0 * 1e-4, 4e-4);
        // Without a gain there is the whole of what the input made.
        EXPECT_GT(gap::leftover_of(model, courses_of(records), false).squares, 1.0);
        EXPECT_EQ(gap::leftover_of(model, courses_of(records), false).gain, 1.0);
    }
}

// What a sensor's end holds says nothing of how far the plant went beyond.
TEST(Leftover, IsNothingBesideReadingsThatAreClipped) {
    drive::Model lag = of({{2.0, 1.0}, {1.0, 0.0}});
    gap::Record record = record_of(200, levels);
    lag.gain = 3.0;
    record.output = response(record, lag);
    for (double& z : record.output) {
        z = std::min(z, 2.0);
    }
    lag.gain = 1.0;
    const gap::Leftover left = gap::leftover_of(lag, courses_of({record}), true);
    EXPECT_LT(left.squares, 1e-16);
    EXPECT_NEAR(left.gain, 3.0, 1e-9);
    EXPECT_LT(gap::leftovers_of(lag, courses_of({record}), true, 1.5).whole.squares, 1e-16);
}

TEST(Leftover, OfWhatRunsAwayIsInfinite) {
    const gap::Record record = record_of(200, levels);
    EXPECT_TRUE(std::isinf(gap::leftover_of(of({{-0.2, 1.0}, {1.0, 0.0}}), courses_of({record}), true).squares));
    // Readings that never move are explained by no gain at all.
    EXPECT_EQ(gap::leftover_of(of({{2.0, 1.0}, {1.0, 0.0}}), courses_of({record}), true).squares < 1e-20, false);
}

// The best offset and initial state of a free motion once what was lately is taken off all three, by hand.
TEST(Leftover, OfWhatIsQuickIsLessWhatWasLately) {
    gap::Record record = record_of(80, [](double) { return 0.0; });
    for (std::size_t i = 0; i < 80; ++i) {
        record.output[i] = std::sin(0.2 * static_cast<double>(i)) + (i > 40 ? 0.5 : 0.0);
    }
    const drive::Model lag = of({{2.0, 1.0}, {1.0, 0.0}});
    constexpr double quick_s = 1.1;
    const auto quick = [](const Values& values) {
        Values left{0.0};
        double lately = values[0];
        for (std::size_t i = 1; i < values.size(); ++i) {
            lately = std::exp(-h / quick_s) * lately + (1.0 - std::exp(-h / quick_s)) * values[i];
            left.push_back(values[i] - lately);
        }
        return left;
    };
    const auto dot = [](const Values& a, const Values& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            sum += a[i] * b[i];
        }
        return sum;
    };
    drive::Model released = lag;
    released.gain = 0.0;
    const Values state = quick(response(record, released, 1.0));
    const Values reading = quick(record.output);  // an offset is never quick
    const double expected = dot(reading, reading) - dot(state, reading) * dot(state, reading) / dot(state, state);
    const gap::Leftovers left = gap::leftovers_of(lag, courses_of({record}), false, quick_s);
    EXPECT_NEAR(left.quick.squares, expected, 1e-9);
    EXPECT_NEAR(left.whole.squares, gap::leftover_of(lag, courses_of({record}), false).squares, 1e-9);
    // Of two records each begins anew.
    const gap::Leftovers both = gap::leftovers_of(lag, courses_of({record, record}), false, quick_s);
    EXPECT_NEAR(both.quick.squares, 2.0 * expected, 1e-9);
}

// A record that one of the even lags made is begun from just that: as many equal lags as the structure has, of nine
// sizes from three tenths of the record down, with a dead time of 0, 0.3, 1, 2 or 4 of them.
TEST(Starts, AreEvenLagsWhereOneMadeTheRecord) {
    const auto begun = [](const char* structure, std::size_t count, int size, double share) {
        const gap::Structure& of_it = *gap::structure_named(structure);
        gap::Record record = record_of(count, levels);
        const double longest_s = 0.3 * record.time_s.back();
        const double lag_s = longest_s * std::pow(h / longest_s, size / 9.0);
        const int lags = of_it.order - of_it.integrators;
        gap::Coefficients made;
        made.gain = 2.0;
        made.delay_s = share * lag_s;
        constexpr double binomials[4][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
        for (int i = 1; i <= lags; ++i) {
            made.denominator.push_back(binomials[lags][i] * std::pow(lag_s, i));
        }
        made.numerator.assign(static_cast<std::size_t>(of_it.zeros), 0.5 * lag_s);
        record.output = response(record, gap::model_of(gap::form_of(of_it, made, true)));
        for (double& z : record.output) {
            z += 0.5;
        }
        drive::Form found = gap::starts_of(of_it, {record}).whole;
        EXPECT_NEAR(found.parameter("gain").value, 2.0, 1e-6) << structure << size << " " << share;
        EXPECT_NEAR(found.parameter("delay_s").value, made.delay_s, 1e-9) << structure << size << " " << share;
        for (int i = 1; i <= lags; ++i) {
            const std::string name = "a" + std::to_string(i);
            EXPECT_NEAR(found.parameter(name).value, made.denominator[static_cast<std::size_t>(i - 1)],
                        1e-9 * made.denominator[static_cast<std::size_t>(i - 1)])
                << structure << size << " " << share;
        }
        if (of_it.zeros > 0) {
            EXPECT_NEAR(found.parameter("b1").value, 0.5 * lag_s, 1e-9) << structure << size << " " << share;
        }
    };
    begun("third_order", 240, 2, 0.0);
    begun("third_order", 240, 3, 0.3);
    begun("second_order", 240, 4, 4.0);
    begun("second_order", 240, 0, 1.0);
    begun("second_order", 240, 8, 2.0);
    begun("second_order_zero", 240, 3, 1.0);
    begun("integrator_lag", 240, 3, 2.0);
    begun("first_order", 240, 5, 4.0);
}

// Coefficients are times to the power of their order: of a half, three quarters and the whole of each.
TEST(Starts, OfFractionalOrdersAreAsLong) {
    const gap::Structure& structure = *gap::structure_named("fractional_second_order");
    for (const double share : {0.5, 0.75, 1.0}) {
        gap::Record record = record_of(240, levels);
        const double longest_s = 0.3 * record.time_s.back();
        const double lag_s = longest_s * std::pow(h / longest_s, 4.0 / 9.0);
        const double first = std::max(share, 0.3);
        const double second = std::max(2.0 * share, 1.3);
        gap::Coefficients made;
        made.orders = {first, second};
        made.denominator = {std::pow(2.0 * lag_s, first), std::pow(lag_s * lag_s, second / 2.0)};
        record.output = response(record, gap::model_of(gap::form_of(structure, made, true)));
        drive::Form found = gap::starts_of(structure, {record}).whole;
        EXPECT_NEAR(found.parameter("a1").value, made.denominator[0], 1e-9 * made.denominator[0]) << share;
        EXPECT_NEAR(found.parameter("a2").value, made.denominator[1], 1e-9 * made.denominator[1]) << share;
        EXPECT_NEAR(found.parameter("alpha1").value, first, 1e-12);
        EXPECT_NEAR(found.parameter("alpha2").value, second, 1e-12);
        EXPECT_FALSE(found.parameter("alpha1").fixed);
        EXPECT_NEAR(found.parameter("alpha1").lower, 0.3, 1e-12);
        EXPECT_NEAR(found.parameter("alpha1").upper, 1.2, 1e-12);
        EXPECT_NEAR(found.parameter("alpha2").lower, 1.3, 1e-12);
        EXPECT_NEAR(found.parameter("alpha2").upper, 2.2, 1e-12);
    }
}

// Of three lags, or a zero, a fit has several ends: two more starts at most, none near another, and none of two lags.
TEST(Starts, LieApartWhereAFitHasSeveralEnds) {
    gap::Record record = record_of(240, levels);
    record.output = response(record, of({{1.1, 3.0}, {2.9, 2.0}, {2.6, 1.0}, {1.0, 0.0}}));
    // A little of what none of them explains, so that none is exact and others leave about as much.
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.output[i] += 0.2 * std::sin(0.7 * record.time_s[i]);
    }
    const auto starts_of = [&](const char* name) { return gap::starts_of(*gap::structure_named(name), {record}); };
    EXPECT_TRUE(starts_of("second_order").elsewhere.empty());
    EXPECT_TRUE(starts_of("fractional_second_order").elsewhere.empty());
    for (const char* name : {"third_order", "second_order_zero", "third_order_zero"}) {
        gap::Starts starts = starts_of(name);
        EXPECT_THAT(starts.elsewhere.size(), testing::AllOf(testing::Ge(1U), testing::Le(2U))) << name;
        std::vector<drive::Form> all = {starts.whole};
        all.insert(all.end(), starts.elsewhere.begin(), starts.elsewhere.end());
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const double late = all[i].parameter("delay_s").value - all[j].parameter("delay_s").value;
                const double a = all[i].parameter("a1").value + all[i].parameter("delay_s").value;
                const double b = all[j].parameter("a1").value + all[j].parameter("delay_s").value;
                EXPECT_TRUE(std::max(a, b) >= 1.5 * std::min(a, b) || std::abs(late) >= 0.2 * std::max(a, b)) << name;
            }
        }
    }
}

TEST(Starts, OfWhatNothingExplainsAreRefused) {
    gap::Record record = record_of(240, levels);
    record.output.assign(240, std::nan(""));
    try {
        (void)gap::starts_of(*gap::structure_named("second_order"), {record});
        FAIL() << "expected a failure";
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        EXPECT_THAT(failure.what(), testing::HasSubstr("made: no second_order (two lags, or an oscillator) explains"));
    }
}

// What is quick is what is younger than three hundredths of the longest record.
TEST(Starts, SayWhatIsQuick) {
    gap::Record record = record_of(201, levels);
    record.output = response(record, of({{2.0, 1.0}, {1.0, 0.0}}));
    const gap::Starts starts = gap::starts_of(*gap::structure_named("first_order"), {record, record_of(101, levels)});
    EXPECT_NEAR(starts.quick_s, 0.03 * 50.0, 1e-12);
}

// --- Forms that are asked for by name.

// A record that one of the starts made is begun from just that: time constants of nine sizes from three tenths of the
// record down, dead times of 0, 0.3, 1, 2 or 4 of them.
TEST(NamedForms, BeginWhereTheRecordWasMade) {
    const auto begun = [](const std::string& name, int size, double share) {
        gap::Record record = record_of(240, levels);
        const double longest_s = 0.3 * record.time_s.back();
        const double lag_s = longest_s * std::pow(h / longest_s, size / 9.0);
        const double delay_s = share * lag_s;
        drive::Model made = name == "fopdt"   ? drive::make_fopdt(2.5, lag_s, delay_s)
                            : name == "sopdt" ? drive::make_sopdt(2.5, lag_s, delay_s)
                                              : of({{lag_s, 2.0}, {1.0, 1.0}});
        made.gain = 2.5;
        made.delay_s = delay_s;
        record.output = response(record, made);
        const drive::Model found = gap::model_of(gap::search_form(name, {record}));
        const std::complex<double> s(0.3, 0.7);
        const auto wanted = drive::evaluate_without_delay(made, s);
        EXPECT_LT(std::abs(drive::evaluate_without_delay(found, s) - wanted), 1e-9 * std::abs(wanted)) << name << size;
        EXPECT_NEAR(found.delay_s, delay_s, 1e-9) << name << size;
    };
    for (const char* name : {"fopdt", "sopdt", "integrator"}) {
        begun(name, 0, 0.3);
        begun(name, 2, 1.0);
        begun(name, 4, 0.0);
        begun(name, 5, 4.0);
        begun(name, 8, 2.0);
    }
    // Of an integrator the gain stands in the coefficients.
    gap::Record record = record_of(240, levels);
    drive::Model made = of({{2.0, 2.0}, {1.0, 1.0}});
    made.gain = 4.0;
    record.output = response(record, made);
    EXPECT_EQ(gap::model_of(gap::search_form("integrator", {record})).gain, 1.0);
}

// A structure is begun as where it is looked for; two orders of any size are begun from two whole ones.
TEST(NamedForms, OfStructuresAreTheirStarts) {
    gap::Record record = record_of(240, levels);
    record.output = response(record, of({{1.2, 2.0}, {0.3, 1.0}, {1.0, 0.0}}));
    const drive::Model second = gap::model_of(gap::search_form("second_order", {record}));
    EXPECT_EQ(second, gap::model_of(gap::starts_of(*gap::structure_named("second_order"), {record}).whole));
    drive::Form two = gap::search_form("niopdt", {record});
    const double gain = drive::static_gain(second);
    EXPECT_NEAR(two.parameter("a2").value, drive::leading_coefficient(second.denominator) / gain, 1e-9);
    EXPECT_NEAR(two.parameter("alpha2").value, 2.0, 1e-12);
}

TEST(NamedForms, AreRefusedByName) {
    const gap::Record record = record_of(240, levels);
    const auto refusal = [&](const std::string& name) -> std::string {
        try {
            (void)gap::search_form(name, {record});
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
            return failure.what();
        }
        return "";
    };
    EXPECT_THAT(refusal("fopd"), testing::AllOf(testing::HasSubstr("fit:fopd: expected one of fopdt, sopdt, niopdt"),
                                                testing::HasSubstr("two_modes; the nearest is fopdt")));
    gap::Record nothing = record;
    nothing.output.assign(240, std::nan(""));
    EXPECT_THROW((void)gap::search_form("sopdt", {nothing}), glsum::Failure);
}

// "fit" looks for a base, "fit:NAME" begins that one.
TEST(NamedForms, AreTakenIntoAQuestion) {
    gap::Record record = record_of(240, levels);
    record.output = response(record, drive::make_fopdt(2.5, 2.0, 0.0));
    gap::Question question{gap::form_to_find(), false, {record}, {}, {}, gap::Metric::simulation, {}, 1};
    gap::take_base(question, "fit:fopdt");
    EXPECT_TRUE(question.refit);
    EXPECT_FALSE(question.find);
    EXPECT_EQ(question.base_name, "fopdt");
    EXPECT_EQ(gap::model_of(question.form), gap::model_of(gap::search_form("fopdt", {record})));
    gap::Question open{gap::form_to_find(), false, {record}, {}, {}, gap::Metric::simulation, {}, 1};
    gap::take_base(open, "fit");
    EXPECT_TRUE(open.refit);
    EXPECT_TRUE(open.find);
    EXPECT_EQ(open.base_name, "");
}

// Whole orders of a given model stay; others are its numbers.
TEST(NamedForms, OfAGivenModelKeepWholeOrders) {
    drive::Model model = of({{0.5, 1.8}, {0.3, 1.0}, {1.0, 0.0}});
    model.numerator = {{0.2, 0.5}, {1.0, 0.0}};
    drive::Form form = gap::form_of(model);
    EXPECT_FALSE(form.parameter("alpha2").fixed);
    EXPECT_TRUE(form.parameter("alpha1").fixed);
    EXPECT_FALSE(form.parameter("beta1").fixed);
    // Coefficients are free, whole ones too.
    for (const char* name : {"a2", "a1", "a0", "b1", "b0", "delay_s"}) {
        EXPECT_FALSE(form.parameter(name).fixed) << name;
    }
}

}  // namespace
