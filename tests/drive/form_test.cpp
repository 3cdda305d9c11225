// Forms at their edges: what is given its order, between which bounds, and what becomes of a start's parts.
#include "drive/form.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "base/failure.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Form;
using drive::Kind;
using drive::Model;
using testing::HasSubstr;

Model fotf(std::vector<drive::Term> numerator, std::vector<drive::Term> denominator) {
    Model model;
    model.kind = Kind::fotf;
    model.numerator = std::move(numerator);
    model.denominator = std::move(denominator);
    return model;
}

// Two terms above and four below, from the lowest order to the highest: each side is turned round, and no term goes
// from one side to the other.
TEST(FormOrder, IsGivenToTheTermsOfEachSide) {
    const Form form(Kind::fotf, fotf({{0.4, 0.6}, {0.3, 0.2}}, {{1.0, 1.8}, {2.0, 1.2}, {3.0, 0.7}, {4.0, 0.3}}));
    const std::vector<double> ordered = {1.0, 0.4, 0.6, 0.3, 0.2, 1.0, 1.8, 2.0, 1.2, 3.0, 0.7, 4.0, 0.3, 0.5, 0.0};
    ASSERT_EQ(form.values().size(), ordered.size());
    EXPECT_EQ(form.in_order(ordered), ordered);
    EXPECT_EQ(form.in_order({1.0, 0.3, 0.2, 0.4, 0.6, 4.0, 0.3, 3.0, 0.7, 2.0, 1.2, 1.0, 1.8, 0.5, 0.0}), ordered);
    EXPECT_EQ(form.in_order({1.0, 0.4, 0.6, 0.3, 0.2, 1.0, 1.8, 2.0, 1.2, 4.0, 0.3, 3.0, 0.7, 0.5, 0.0}), ordered);
}

TEST(FormOrder, OfEqualOrdersEachTermStays) {
    const Form form(Kind::niopdt, plants::niopdt());
    const std::vector<double> equal = {1.0, 1.0, 0.0, 0.6, 1.0, 0.2, 1.0, 1.0, 0.0, 0.5, 0.0};
    EXPECT_EQ(form.in_order(equal), equal);
}

// Both terms have to fit where they go, coefficient and order; the bounds themselves do.
TEST(FormOrder, IsGivenWithinTheBoundsOfAllFour) {
    const std::vector<double> swapped = {1.0, 1.0, 0.0, 4.0, 0.3, 1.0, 1.8, 0.5, 0.0};
    const std::vector<double> ordered = {1.0, 1.0, 0.0, 1.0, 1.8, 4.0, 0.3, 0.5, 0.0};
    Form form(Kind::fotf, fotf({{1.0, 0.0}}, {{1.0, 1.8}, {4.0, 0.3}}));
    const std::pair<const char*, double> taken[] = {{"a1", 1.0}, {"alpha1", 1.8}, {"a0", 4.0}, {"alpha0", 0.3}};
    for (const auto& [name, value] : taken) {
        form.parameter(name).lower = form.parameter(name).upper = value;
    }
    EXPECT_EQ(form.in_order(swapped), ordered);
    for (const auto& [name, value] : taken) {
        form.parameter(name).lower = value + 0.125;
        form.parameter(name).upper = value + 8.0;
        EXPECT_EQ(form.in_order(swapped), swapped) << name;
        form.parameter(name).lower = value - 8.0;
        form.parameter(name).upper = value - 0.125;
        EXPECT_EQ(form.in_order(swapped), swapped) << name;
        form.parameter(name).lower = form.parameter(name).upper = value;
    }
}

// A constant above goes into what is below: 3 * 2 / (... + 1) is 1 / ((... + 1) / 6).
TEST(Form, OfNiopdtHasOneAboveAndAllBelow) {
    Model start = fotf({{2.0, 0.0}}, {{0.75, 1.9}, {0.375, 0.8}, {1.5, 0.0}});
    start.gain = 3.0;
    const Form form(Kind::niopdt, start);
    const Model model = form.to_model(form.values());
    EXPECT_EQ(model.kind, Kind::niopdt);
    EXPECT_EQ(model.gain, 1.0);
    EXPECT_EQ(model.numerator, (std::vector<drive::Term>{{1.0, 0.0}}));
    EXPECT_EQ(model.denominator, (std::vector<drive::Term>{{0.125, 1.9}, {0.0625, 0.8}, {0.25, 0.0}}));
    // Of whatever kind the start was.
    const Form other(Kind::fotf, drive::make_sopdt(2.0, 0.5, 0.25));
    EXPECT_EQ(other.to_model(other.values()).kind, Kind::fotf);
}

TEST(Form, NamesWhatItHasWhereItIsAskedForSomethingElse) {
    Form form(Kind::fopdt, plants::fopdt());
    try {
        (void)form.parameter("a3");
        ADD_FAILURE() << "found";
    } catch (const glsum::Failure& failure) {
        EXPECT_THAT(failure.what(), HasSubstr("gain, time_constant_s, delay_s, offset, found a3"));
    }
}

// Which parameters a form has, where they begin and between which bounds: by hand for each kind of start.
TEST(Form, ItsParametersAreThoseNearestToItsStart) {
    struct Row {
        const char* name;
        double value, lower, upper;
        bool fixed;
    };
    const auto expect = [](const Form& form, const std::vector<Row>& rows) {
        ASSERT_EQ(form.parameters().size(), rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const drive::Parameter& parameter = form.parameters()[i];
            EXPECT_EQ(parameter.name, rows[i].name);
            EXPECT_NEAR(parameter.value, rows[i].value, 1e-12) << rows[i].name;
            EXPECT_EQ(parameter.lower, rows[i].lower) << rows[i].name;
            EXPECT_EQ(parameter.upper, rows[i].upper) << rows[i].name;
            EXPECT_EQ(parameter.fixed, rows[i].fixed) << rows[i].name;
            EXPECT_FALSE(parameter.bounds_are_given);
        }
    };
    constexpr double far = 1e9;
    const Row offset{"offset", 0.0, -far, far, true};
    const auto mean = [&](double gain, double time_constant_s, double delay_s) {
        return std::vector<Row>{{"gain", gain, -far, far, false},
                                {"time_constant_s", time_constant_s, 1e-9, far, false},
                                {"delay_s", delay_s, 0.0, far, false},
                                offset};
    };
    expect(Form(Kind::fopdt, drive::make_fopdt(2.0, 0.5, 0.25)), mean(2.0, 0.5, 0.25));
    expect(Form(Kind::sopdt, drive::make_sopdt(2.0, 0.5, 0.25)), mean(2.0, 0.5, 0.25));
    expect(Form(Kind::sopdt, drive::make_fopdt(2.0, 0.5, 0.25)), mean(2.0, 0.25, 0.25));  // shared by two
    expect(Form(Kind::fopdt, drive::make_sopdt(2.0, 0.5, 0.25)), mean(2.0, 0.75, 0.25));  // three quarters of both
    Model scaled;
    scaled.kind = Kind::fotf;
    scaled.gain = 3.0;
    scaled.denominator = {{0.5, 1.2}, {4.0, 0.0}};
    expect(Form(Kind::fopdt, scaled), mean(0.75, 0.125, 0.0));
    scaled.denominator = {{0.5, 1.0}};  // an integrator has neither gain nor time constant
    expect(Form(Kind::fopdt, scaled), mean(3.0, 0.5, 0.0));
    scaled.denominator = {{0.5, 0.4}, {4.0, 0.0}};
    expect(Form(Kind::fopdt, scaled), mean(0.75, 1e-6, 0.0));

    const std::vector<Row> common = {
        {"gain", 1.0, -far, far, true}, {"b0", 1.0, -far, far, true}, {"beta0", 0.0, 0.0, 2.0, true}};
    const auto niopdt = [&](double a2, double alpha2, double a1, double alpha1, double a0, double delay_s,
                            double highest) {
        std::vector<Row> rows = common;
        rows.insert(rows.end(), {{"a2", a2, -far, far, false},
                                 {"alpha2", alpha2, 0.01, highest, false},
                                 {"a1", a1, -far, far, false},
                                 {"alpha1", alpha1, 0.01, 2.0, false},
                                 {"a0", a0, -far, far, false},
                                 {"alpha0", 0.0, 0.0, 2.0, true},
                                 {"delay_s", delay_s, 0.0, far, false},
                                 offset});
        return rows;
    };
    // (11) as the start of (12): T^2, 2, 2 T, 1, and all over the gain.
    expect(Form(Kind::niopdt, drive::make_sopdt(2.0, 0.5, 0.25)), niopdt(0.125, 2.0, 0.5, 1.0, 0.5, 0.25, 2.5));
    expect(Form(Kind::niopdt, drive::make_fopdt(2.0, 0.5, 0.25)), niopdt(0.03125, 2.0, 0.25, 1.0, 0.5, 0.25, 2.5));
    expect(Form(Kind::niopdt, plants::niopdt()), niopdt(0.18234, 1.9909, 0.65536, 0.98319, 0.9992, 1.0, 1.9909 + 0.5));
    Model with_zero;
    with_zero.kind = Kind::fotf;
    with_zero.gain = 3.0;
    with_zero.numerator = {{1.0, 0.0}, {0.4, 0.6}};
    with_zero.denominator = {{1.0, 0.0}, {0.25, 1.75}};
    expect(Form(Kind::fotf, with_zero), {{"gain", 3.0, -far, far, true},
                                         {"b1", 0.4, -far, far, false},
                                         {"beta1", 0.6, 0.01, 2.0, false},
                                         {"b0", 1.0, -far, far, false},
                                         {"beta0", 0.0, 0.0, 2.0, true},
                                         {"a1", 0.25, -far, far, false},
                                         {"alpha1", 1.75, 0.01, 2.25, false},
                                         {"a0", 1.0, -far, far, false},
                                         {"alpha0", 0.0, 0.0, 2.0, true},
                                         {"delay_s", 0.0, 0.0, far, false},
                                         offset});
    // And back: the values of a form are its model.
    Form form(Kind::niopdt, plants::niopdt());
    std::vector<double> values;
    for (const drive::Parameter& parameter : form.parameters()) {
        values.push_back(parameter.value);
    }
    const Model back = form.to_model(values);
    EXPECT_EQ(back.denominator, plants::niopdt().denominator);
    EXPECT_EQ(back.delay_s, 1.0);
    EXPECT_EQ(back.gain, 1.0);
    EXPECT_EQ(form.parameter("a1").value, 0.65536);
    EXPECT_THROW((void)form.parameter("a3"), glsum::Failure);
}

TEST(Form, GivesTermsTheirOrderAsFarAsBoundsAllow) {
    Form form(Kind::niopdt, plants::niopdt());
    const std::vector<double> swapped = {1.0, 1.0, 0.0, 0.6, 0.9, 0.2, 1.9, 1.0, 0.0, 0.5, 0.0};
    const std::vector<double> ordered = {1.0, 1.0, 0.0, 0.2, 1.9, 0.6, 0.9, 1.0, 0.0, 0.5, 0.0};
    EXPECT_EQ(form.in_order(swapped), ordered);
    EXPECT_EQ(form.in_order(ordered), ordered);
    form.parameter("alpha1").upper = 1.5;
    EXPECT_EQ(form.in_order({1.0, 1.0, 0.0, 0.6, 0.9, 0.2, 1.6, 1.0, 0.0, 0.5, 0.0}),
              (std::vector<double>{1.0, 1.0, 0.0, 0.2, 1.6, 0.6, 0.9, 1.0, 0.0, 0.5, 0.0}));
    form.parameter("alpha2").upper = 1.5;
    EXPECT_EQ(form.in_order(swapped), swapped);
    form.parameter("alpha2").upper = 2.5;
    form.parameter("a1").fixed = true;
    EXPECT_EQ(form.in_order(swapped), swapped);
}

}  // namespace
