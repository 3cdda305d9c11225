// Beside which of the descriptions that were found causes are looked for.
#include "gap/drive/base/worth_asking.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using testing::ElementsAre;
using testing::IsNull;
using testing::NotNull;

gap::Described description(const std::string& name, double aside, double validation, int numbers, int integrators = 0) {
    return {name, "", gap::form_to_find(), aside, validation, numbers, integrators};
}

std::vector<std::string> asked(const std::vector<gap::Described>& found) {
    std::vector<std::string> names;
    for (const gap::Described* one : gap::worth_asking(found)) {
        names.push_back(one->name);
    }
    return names;
}

TEST(WorthAsking, TheBestOneAlwaysIs) { EXPECT_THAT(asked({description("best", 0.1, 0.1, 3)}), ElementsAre("best")); }

// A simpler one leaves at most twice as much, or clearly less where neither was fitted.
TEST(WorthAsking, ASimplerOneIsThatGoesNearlyAsFar) {
    const auto best = description("best", 0.1, 0.1, 3);
    EXPECT_THAT(asked({best, description("simpler", 0.199, 0.199, 2)}), ElementsAre("best", "simpler"));
    EXPECT_THAT(asked({best, description("simpler", 0.201, 0.199, 2)}), ElementsAre("best"));
    EXPECT_THAT(asked({best, description("simpler", 0.9, 0.079, 2)}), ElementsAre("best", "simpler"));
    EXPECT_THAT(asked({best, description("simpler", 0.9, 0.081, 2)}), ElementsAre("best"));
    EXPECT_THAT(asked({best, description("first", 0.15, 0.15, 2), description("second", 0.16, 0.16, 1)}),
                ElementsAre("best", "first"));
}

// A richer one is as good to a fifth, and says 3 % more in one of both.
TEST(WorthAsking, ARicherOneIsThatSaysMore) {
    const auto best = description("best", 0.1, 0.1, 3);
    EXPECT_THAT(asked({best, description("richer", 0.0969, 0.119, 4)}), ElementsAre("best", "richer"));
    EXPECT_THAT(asked({best, description("richer", 0.0969, 0.121, 4)}), ElementsAre("best"));
    EXPECT_THAT(asked({best, description("richer", 0.0971, 0.0971, 4)}), ElementsAre("best"));
    EXPECT_THAT(asked({best, description("as rich", 0.0969, 0.0969, 3)}), ElementsAre("best"));
}

TEST(WorthAsking, OneThatIntegratesIsBesideOneThatRests) {
    const auto best = description("best", 0.1, 0.1, 3);
    EXPECT_THAT(asked({best, description("integrates", 0.159, 0.159, 2, 1)}), ElementsAre("best", "integrates"));
    EXPECT_THAT(asked({best, description("integrates", 0.161, 0.159, 2, 1)}), ElementsAre("best"));
    EXPECT_THAT(asked({best, description("twice", 0.1, 0.1, 2, 2)}), ElementsAre("best"));
    const auto moves = description("moves", 0.1, 0.1, 3, 1);
    EXPECT_THAT(asked({moves, description("rests", 0.159, 0.159, 4)}), ElementsAre("moves", "rests"));
}

TEST(WorthAsking, OneLagMoreIsOneNumberMore) {
    const std::vector<gap::Described> found = {description("one", 0.1, 0.1, 2), description("three", 0.1, 0.1, 4),
                                               description("integrates", 0.1, 0.1, 3, 1),
                                               description("two", 0.1, 0.1, 3)};
    const gap::Described* more = gap::with_one_lag_more(found, found[0]);
    ASSERT_THAT(more, NotNull());
    EXPECT_EQ(more->name, "two");
    EXPECT_THAT(gap::with_one_lag_more(found, found[1]), IsNull());
}

// One lag of any order may be a speed's; a third one is not what a mass on a spring has.
TEST(WorthAsking, APlaceHasWhoHasTwoLags) {
    const std::vector<gap::Described> found = {
        description("first_order", 0.1, 0.1, 2), description("fractional_lag", 0.1, 0.1, 3),
        description("third_order", 0.1, 0.1, 4), description("fractional_second_order", 0.2, 0.2, 5),
        description("second_order", 0.3, 0.3, 3)};
    EXPECT_EQ(gap::with_a_place(found, {&found[0]}), &found[3]);  // the better of the two
    const std::vector<gap::Described> without_fractional = {found[0], found[4]};
    EXPECT_EQ(gap::with_a_place(without_fractional, {})->name, "second_order");
    EXPECT_THAT(gap::with_a_place(std::vector(found.begin(), found.begin() + 3), {}), IsNull());
}

// A fractional order bends to friction, and then leaves a curve to explain; a whole one cannot.
TEST(WorthAsking, APlaceHasTheWholeOneOnceTheFractionalOneWasAsked) {
    const std::vector<gap::Described> found = {description("fractional_second_order", 0.1, 0.1, 5),
                                               description("first_order", 0.2, 0.2, 2),
                                               description("second_order", 0.3, 0.3, 3)};
    EXPECT_EQ(gap::with_a_place(found, {&found[0], &found[1]}), &found[2]);
    EXPECT_EQ(gap::with_a_place(found, {&found[0], &found[1], &found[2]}), &found[2]);  // it is in its list already
    const std::vector<gap::Described> whole_first = {found[2], found[0]};
    EXPECT_EQ(gap::with_a_place(whole_first, {&whole_first[0]}), &whole_first[0]);
}

TEST(WorthAsking, TheSimplestOneIntegratesAsOften) {
    const std::vector<gap::Described> found = {
        description("third_order", 0.1, 0.1, 4), description("pure_integrator", 0.1, 0.1, 1, 1),
        description("first_order", 9.0, 9.0, 2), description("second_order", 0.1, 0.1, 3)};
    EXPECT_EQ(gap::simplest_like(found, found[0]), &found[2]);
    EXPECT_EQ(gap::simplest_like(found, found[2]), &found[2]);
    EXPECT_EQ(gap::simplest_like(found, found[1]), &found[1]);
}

}  // namespace
