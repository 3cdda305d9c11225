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

}  // namespace
