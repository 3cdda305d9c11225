// How the shortest length is looked for: which lengths are measured, and which is found where errors go up and down.
#include "bench/choose/reach.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace {

using choose::ErrorAt;
using choose::Reach;
using Lengths = std::vector<std::size_t>;

constexpr double limit = 0.1;

// Errors by the length, and what was asked.
struct Made : choose::ErrorSource {
    std::size_t full = 100;
    std::size_t cuts = 0;  // below this length truncation alone is beyond the limit
    double bound = 0.0;
    std::string fault;
    std::function<double(std::size_t)> error_of;
    Lengths whole;    // measured whole
    Lengths scanned;  // measured as far as the limit

    [[nodiscard]] std::size_t longest() const override { return full; }
    [[nodiscard]] double truncation(std::size_t taps) const override { return taps < cuts ? 2.0 * limit : 0.0; }
    [[nodiscard]] double rounding_bound(const std::string&, std::size_t) const override { return bound; }
    [[nodiscard]] ErrorAt error(const std::string&, std::size_t taps) override {
        whole.push_back(taps);
        return {.error = error_of(taps), .signal = "made", .fault = fault};
    }
    [[nodiscard]] bool meets(const std::string&, std::size_t taps, double asked) override {
        EXPECT_EQ(asked, limit);
        scanned.push_back(taps);
        return fault.empty() && error_of(taps) <= asked;
    }
};

Reach found(Made& errors) { return choose::reach(errors, "any", limit); }

Lengths from_to(std::size_t first, std::size_t last) {
    Lengths all;
    for (std::size_t taps = first; taps <= last; ++taps) {
        all.push_back(taps);
    }
    return all;
}

const Lengths ladder = {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 15, 18, 22, 27, 33, 41, 51, 63, 78, 97, 100};

TEST(Reach, WhereTruncationDoesTheFirstLengthIsTaken) {
    Made errors;
    errors.cuts = 30;
    errors.error_of = [](std::size_t) { return limit; };
    const Reach reach = found(errors);
    EXPECT_EQ(reach.shortest, 30U);
    EXPECT_EQ(reach.best_taps, 30U);
    EXPECT_EQ(errors.whole, Lengths{30});
    EXPECT_TRUE(errors.scanned.empty());  // nothing shorter is possible: no rounding makes good what is cut
}

TEST(Reach, WhatRoundingMayMakeGoodIsTriedFromTheShortestOn) {
    Made errors;
    errors.cuts = 30;
    errors.bound = limit;  // 2 limits of truncation and one of rounding: just possible
    errors.error_of = [](std::size_t taps) { return taps == 12 || taps >= 30 ? limit : 1.5 * limit; };
    EXPECT_EQ(found(errors).shortest, 12U);
    EXPECT_EQ(errors.scanned, from_to(1, 12));
    EXPECT_TRUE(errors.whole.empty());
    Made short_of = errors;
    short_of.scanned.clear();
    short_of.bound = 0.99 * limit;
    EXPECT_EQ(found(short_of).shortest, 30U);
    EXPECT_TRUE(short_of.scanned.empty());
}

// Each rung a quarter longer than the last, up to full memory.
TEST(Reach, BeyondEveryRungItIsGivenUp) {
    Made errors;
    errors.error_of = [](std::size_t taps) { return taps == 41 ? 1.251 * limit : 1.5 * limit; };
    const Reach reach = found(errors);
    EXPECT_FALSE(reach.shortest);
    EXPECT_EQ(reach.best_taps, 41U);
    EXPECT_EQ(reach.best.error, 1.251 * limit);
    EXPECT_EQ(errors.whole, ladder);
    EXPECT_TRUE(errors.scanned.empty());
}

TEST(Reach, ARungThatMissesByAQuarterIsLookedAbout) {
    for (const std::size_t best : {1U, 41U, 100U}) {
        Made errors;
        errors.error_of = [&](std::size_t taps) { return taps == best ? 1.25 * limit : 1.5 * limit; };
        const Reach reach = found(errors);
        EXPECT_FALSE(reach.shortest);
        EXPECT_EQ(reach.best_taps, best);
        // From the rung before it to the one behind it, of which each was measured.
        EXPECT_EQ(errors.scanned, best == 1 ? from_to(1, 1) : best == 41 ? from_to(33, 50) : from_to(97, 99)) << best;
    }
    Made lucky;
    lucky.error_of = [](std::size_t taps) { return taps == 41 ? 1.2 * limit : taps == 47 ? limit : 1.5 * limit; };
    EXPECT_EQ(found(lucky).shortest, 47U);
}

// Of long rungs as many lengths as twice a scan, and no more.
TEST(Reach, AboutALongRungTheSearchEnds) {
    Made errors;
    errors.full = 20000;
    errors.cuts = 6000;
    errors.error_of = [](std::size_t taps) { return taps == 7500 ? 1.2 * limit : 1.5 * limit; };
    EXPECT_FALSE(found(errors).shortest);
    EXPECT_EQ(errors.scanned, from_to(6000, 6000 + 2 * 512 - 1));
}

TEST(Reach, BelowTheFirstRungThatMeetsEveryLengthIsTried) {
    Made errors;
    errors.error_of = [](std::size_t taps) { return taps >= 37 ? limit : 1.5 * limit; };
    EXPECT_EQ(found(errors).shortest, 37U);
    EXPECT_EQ(errors.whole.back(), 41U);
    EXPECT_EQ(errors.scanned, from_to(1, 37));
    Made lucky;
    lucky.error_of = [](std::size_t taps) { return taps == 9 || taps >= 37 ? limit : 1.5 * limit; };
    EXPECT_EQ(found(lucky).shortest, 9U);
    Made rung;  // the rung itself, where nothing below it does
    rung.error_of = [](std::size_t taps) { return taps == 41 ? limit : 1.5 * limit; };
    EXPECT_EQ(found(rung).shortest, 41U);
}

// At most 512 lengths in a row are measured one by one.
TEST(Reach, ALongerGapIsBisectedFirst) {
    const auto meets_from = [](std::size_t from, std::size_t lucky, std::size_t full) {
        Made errors;
        errors.full = full;
        errors.cuts = 1000;
        errors.error_of = [=](std::size_t taps) { return taps == lucky || taps >= from ? limit : 1.5 * limit; };
        return errors;
    };
    // 1000, 1250 and the full memory, 512 beyond the first: all of them.
    Made near = meets_from(1512, 0, 1512);
    EXPECT_EQ(found(near).shortest, 1512U);
    EXPECT_EQ(near.scanned, from_to(1000, 1511));
    // One more, and only those above the rung before.
    Made farther = meets_from(1513, 1100, 1513);
    EXPECT_EQ(found(farther).shortest, 1513U);
    EXPECT_EQ(farther.scanned, from_to(1250, 1512));
    // Of rungs 11 632, 14 540 and 18 175: halved until a scan is left.
    for (const std::size_t from : {12600U, 14100U, 15600U}) {
        Made far = meets_from(from, 0, 20000);
        EXPECT_EQ(found(far).shortest, from);
        EXPECT_LE(far.scanned.size(), 512U + 4U);
        EXPECT_GE(far.scanned.size(), 3U);
    }
}

// A wrong answer is none, however small its error.
TEST(Reach, AFaultMeetsNoLimit) {
    Made errors;
    errors.fault = "broken";
    errors.error_of = [](std::size_t) { return 0.0; };
    const Reach reach = found(errors);
    EXPECT_FALSE(reach.shortest);
    EXPECT_EQ(reach.best.fault, "broken");
    EXPECT_EQ(errors.whole, ladder);
    EXPECT_TRUE(errors.scanned.empty());
}

// Few lengths: in turn until one meets the limit, or so many in a row came no nearer by a twentieth.
TEST(Reach, OfFewLengthsStopsWhereNothingIsGained) {
    struct Patient : Made {
        [[nodiscard]] std::size_t patience() const override { return 3; }
    } errors;
    const Lengths few = {1, 2, 4, 8, 16, 32, 64, 100};
    errors.error_of = [](std::size_t taps) { return taps < 8 ? 1.0 / static_cast<double>(taps) : 0.24; };
    Reach reach = choose::reach_of(errors, "any", few, limit);
    EXPECT_FALSE(reach.shortest);
    EXPECT_EQ(errors.whole, (Lengths{1, 2, 4, 8, 16, 32}));
    EXPECT_EQ(reach.best_taps, 8U);
    EXPECT_EQ(reach.best.error, 0.24);
    errors.error_of = [](std::size_t taps) { return taps < 32 ? 1.0 : limit; };
    EXPECT_FALSE(choose::reach_of(errors, "any", few, limit).shortest);
    errors.error_of = [](std::size_t taps) { return taps < 8 ? 1.0 : limit; };
    EXPECT_EQ(choose::reach_of(errors, "any", few, limit).shortest, 8U);
    // A length that a kernel refuses says nothing of longer ones.
    errors.fault = "refused";
    errors.whole.clear();
    EXPECT_FALSE(choose::reach_of(errors, "any", few, limit).shortest);
    EXPECT_EQ(errors.whole, few);
}

// Halving, step by step: of rungs 11 632 and 14 540 the lengths between which the limit is met come nearer.
TEST(Reach, AGapIsHalvedUntilAScanIsLeft) {
    Made errors;
    errors.full = 20000;
    errors.cuts = 1000;
    errors.error_of = [](std::size_t taps) { return taps >= 12600 ? limit : 1.5 * limit; };
    EXPECT_EQ(found(errors).shortest, 12600U);
    // Gaps of 2908, 1454, 727, and 363, which is no more than 512; the scan begins 512 before the length that does.
    Lengths expected = {13086, 12359, 12722};
    for (const std::size_t taps : from_to(12210, 12600)) {
        expected.push_back(taps);
    }
    EXPECT_EQ(errors.scanned, expected);
    // From 4096 to 5120 a gap of 1024: half of it is a scan.
    Made twice;
    twice.full = 20000;
    twice.cuts = 4096;
    twice.error_of = [](std::size_t taps) { return taps >= 5000 ? limit : 1.5 * limit; };
    EXPECT_EQ(found(twice).shortest, 5000U);
    Lengths once = {4608};
    for (const std::size_t taps : from_to(4608, 5000)) {
        once.push_back(taps);
    }
    EXPECT_EQ(twice.scanned, once);
}

// What truncation costs may rise again: rungs stand only where it is within the limit, exactly at it too.
struct Bumpy : Made {
    std::function<double(std::size_t)> truncation_at;
    [[nodiscard]] double truncation(std::size_t taps) const override { return truncation_at(taps); }
};

TEST(Reach, RungsStandWhereTruncationIsWithinTheLimit) {
    Bumpy errors;
    errors.full = 40;
    errors.truncation_at = [](std::size_t taps) {
        return taps < 5 || (taps >= 8 && taps <= 11) ? 1.01 * limit : taps < 8 ? limit : 0.0;
    };
    errors.error_of = [](std::size_t) { return 1.5 * limit; };
    const Reach reach = found(errors);
    EXPECT_FALSE(reach.shortest);
    // By a quarter from rung to rung; 8 to 11 will not do.
    EXPECT_EQ(errors.whole, (Lengths{5, 6, 7, 12, 15, 18, 22, 27, 33, 40}));
    EXPECT_EQ(reach.best_taps, 5U);  // of equal errors the shortest
    EXPECT_TRUE(errors.scanned.empty());
}

// No record is longer than its full memory, which leaves nothing out.
TEST(Reach, WhereNoWindowWillDoFullMemoryIsAsked) {
    Made errors;
    errors.cuts = 1000;
    errors.error_of = [](std::size_t) { return limit; };
    const Reach reach = found(errors);
    EXPECT_EQ(reach.shortest, 100U);
    EXPECT_EQ(errors.whole, Lengths{100});
}

// The best is the best right answer, be there ever so small wrong ones.
TEST(Reach, AWrongAnswerIsNotTheBest) {
    struct WrongAt8 : Made {
        [[nodiscard]] ErrorAt error(const std::string& kernel, std::size_t taps) override {
            ErrorAt at = Made::error(kernel, taps);
            at.fault = taps == 8 ? "broken" : "";
            return at;
        }
    } errors;
    errors.error_of = [](std::size_t taps) { return taps == 8 ? 0.0 : taps == 27 ? 2.0 * limit : 3.0 * limit; };
    const Reach reach = found(errors);
    EXPECT_FALSE(reach.shortest);
    EXPECT_EQ(reach.best_taps, 27U);
    EXPECT_EQ(errors.whole, ladder);
}

// Errors by the place of a length.
struct InTurn : Made {
    std::size_t turns = 1;
    std::vector<ErrorAt> errors;
    [[nodiscard]] std::size_t patience() const override { return turns; }
    [[nodiscard]] ErrorAt error(const std::string&, std::size_t taps) override {
        whole.push_back(taps);
        return errors.at(taps - 1);
    }
};

InTurn in_turn(std::size_t patience, const std::vector<double>& errors) {
    InTurn source;
    source.turns = patience;
    for (const double error : errors) {
        source.errors.push_back({.error = error, .signal = "made", .fault = {}});
    }
    return source;
}

Reach reach_of(InTurn& source) { return choose::reach_of(source, "any", from_to(1, source.errors.size()), limit); }

// Of equal errors the shortest length's is the best.
TEST(Reach, OfFewLengthsTheFirstOfTheLeastIsTheBest) {
    const auto best_of = [](const std::vector<double>& errors) {
        InTurn source = in_turn(errors.size(), errors);
        const Reach reach = reach_of(source);
        EXPECT_EQ(reach.best.error, errors.at(reach.best_taps - 1));
        return reach.best_taps;
    };
    EXPECT_EQ(best_of({0.5, 0.75, 0.5}), 1U);
    EXPECT_EQ(best_of({0.75, 0.5, 0.5, 0.6}), 2U);
    EXPECT_EQ(best_of({0.75, 0.6, 0.5}), 3U);
}

// How many lengths are asked. \param fault_at  the length that is refused; 0: none
std::size_t asked_of(std::size_t patience, const std::vector<double>& errors, std::size_t fault_at = 0) {
    InTurn source = in_turn(patience, errors);
    if (fault_at > 0) {
        source.errors.at(fault_at - 1).fault = "refused";
    }
    EXPECT_FALSE(reach_of(source).shortest);
    return source.whole.size();
}

TEST(Reach, AGainIsATwentiethOfTheBestSoFar) {
    EXPECT_EQ(asked_of(1, {1.0, 0.945, 0.945, 0.5}), 3U);
    EXPECT_EQ(asked_of(1, {1.0, 0.955, 0.5}), 2U);
    EXPECT_EQ(asked_of(1, {1.0, 0.95, 0.5}), 2U);  // no less than that
    // In steps smaller than that nothing is gained until they add up.
    EXPECT_EQ(asked_of(2, {1.0, 0.96, 0.94, 0.94, 0.94, 0.5}), 5U);
    // A gain begins the count again.
    EXPECT_EQ(asked_of(2, {1.0, 1.0, 0.5, 0.5, 0.5, 0.25}), 5U);
    // A refusal does so too, but it sets no new mark.
    EXPECT_EQ(asked_of(1, {1.0, INFINITY, 1.0, 0.5}, 2), 3U);
    EXPECT_EQ(asked_of(2, {1.0, 1.0, INFINITY, 1.0, 1.0, 0.5}, 3), 5U);
}

}  // namespace
