// The search on made-up kernels: errors that are not monotone, costs that fall at group ends, against a plain loop.
#include "bench/choose/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <tuple>
#include <utility>

#include "tests/choose/few_kernels.hpp"

namespace {

using choose::Candidate;
using choose::Choice;
using choose::Cost;
using choose::ErrorAt;
using choose::Limits;
using choose::Standing;
using test::cost_of;
using test::Few;

struct Made {
    double rounding;  // at one tap; grows with the root of the length; below 0 it makes good what truncation costs
    double wobble;    // of the error, relative
    double per_tap;
    double group;  // taps that cost the same
    double bytes_per_tap;
    bool costly = false;
    std::string fault = {};
};

constexpr std::size_t longest = 400;

class MadeErrors : public choose::ErrorSource {
public:
    explicit MadeErrors(const std::map<std::string, Made>& kernels) : kernels_(kernels) {}
    [[nodiscard]] std::size_t longest() const override { return ::longest; }
    // Falls, with bumps.
    [[nodiscard]] double truncation(std::size_t taps) const override {
        const auto l = static_cast<double>(taps);
        return taps >= ::longest ? 0.0 : std::pow(l, -0.6) * (1.0 + 0.05 * std::sin(l / 3.0));
    }
    [[nodiscard]] double rounding_bound(const std::string& kernel, std::size_t taps) const override {
        const Made& made = kernels_.at(kernel);
        return std::fabs(made.rounding) * std::sqrt(static_cast<double>(taps)) * (1.0 + made.wobble);
    }
    [[nodiscard]] ErrorAt error(const std::string& kernel, std::size_t taps) override {
        const Made& made = kernels_.at(kernel);
        if (!made.fault.empty()) {
            return {.error = INFINITY, .signal = {}, .fault = made.fault};
        }
        const auto l = static_cast<double>(taps);
        const double rounding = made.rounding * std::sqrt(l) * (1.0 + made.wobble * std::sin(l * 1.7));
        return {.error = std::fabs(truncation(taps) + rounding), .signal = "made", .fault = {}};
    }
    [[nodiscard]] bool meets(const std::string& kernel, std::size_t taps, double limit) override {
        const ErrorAt at = error(kernel, taps);
        return at.fault.empty() && at.error <= limit;
    }

private:
    std::map<std::string, Made> kernels_;
};

class MadeCosts : public choose::CostSource {
public:
    explicit MadeCosts(const std::map<std::string, Made>& kernels) : kernels_(kernels) {}
    [[nodiscard]] std::string unit() const override { return "instructions"; }
    [[nodiscard]] std::string limited_unit() const override { return "instructions"; }
    [[nodiscard]] bool exact() const override { return true; }
    [[nodiscard]] bool costly(const std::string& kernel) const override { return kernels_.at(kernel).costly; }
    [[nodiscard]] Cost cost(const std::string& kernel, std::size_t taps) const {
        const Made& made = kernels_.at(kernel);
        const auto past = static_cast<double>(taps - 1);
        // The rest of a group costs more than its taps would in a whole one.
        const double rest = std::fmod(past, made.group);
        Cost cost;
        cost.value = cost.limited = 20.0 + made.per_tap * (past - rest) + 2.5 * made.per_tap * rest;
        cost.bytes = 12.0 + made.bytes_per_tap * past;
        return cost;
    }
    [[nodiscard]] std::vector<Cost> costs(const std::vector<choose::Case>& cases) override {
        std::vector<Cost> found;
        for (const auto& [kernel, taps] : cases) {
            found.push_back(cost(kernel, taps));
        }
        return found;
    }

private:
    std::map<std::string, Made> kernels_;
};

const std::map<std::string, Made> kernels = {
    {"exact", {1e-12, 0.0, 75.0, 1.0, 16.0, true}},
    {"single", {1e-7, 0.3, 6.0, 1.0, 8.0}},
    {"groups", {1e-7, 0.3, 4.0, 4.0, 12.0}},
    {"coarse", {2e-3, 0.3, 3.0, 2.0, 4.0}},
    {"lucky", {-1e-3, 0.2, 3.5, 1.0, 6.0}},
    {"coarsest", {2e-2, 0.2, 1.0, 2.0, 2.0}},
    {"broken", {0.0, 0.0, 0.5, 1.0, 1.0, false, "it is broken"}},
};

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const auto& [name, made] : kernels) {
        all.push_back(name);
    }
    return all;
}

bool allowed(const Candidate& candidate, const Limits& limits) {
    return candidate.error.error <= limits.max_error && candidate.cost.limited <= limits.max_cost.value_or(1e300) &&
           candidate.cost.bytes <= limits.max_bytes.value_or(1e300);
}

// Budgets at random, of what the search is given to choose among. \return how many nothing fits
int agree_with_a_plain_loop(const std::vector<std::string>& names, double least_error, double most_error) {
    MadeErrors errors(kernels);
    MadeCosts costs(kernels);
    std::mt19937_64 random(7);
    const auto between = [&](double low, double high) {
        return low * std::pow(high / low, static_cast<double>(random() >> 11) * 0x1p-53);
    };
    int nothing = 0;
    for (int budget = 0; budget < 500; ++budget) {
        Limits limits{between(least_error, most_error), {}, {}};
        if (budget % 2 == 0) {
            limits.max_cost = between(50.0, 5000.0);
        }
        if (budget % 3 == 0) {
            limits.max_bytes = between(50.0, 8000.0);
        }
        std::optional<Candidate> best;
        for (const std::string& kernel : names) {
            for (std::size_t taps = 1; taps <= longest; ++taps) {
                const Candidate candidate{kernel, taps, errors.error(kernel, taps), costs.cost(kernel, taps)};
                if (allowed(candidate, limits) && (!best || choose::better(candidate, *best))) {
                    best = candidate;
                }
            }
        }
        const Choice found = choose::choose(errors, costs, names, limits, 1, false);
        EXPECT_EQ(found.chosen.has_value(), best.has_value()) << budget;
        if (best && found.chosen) {
            EXPECT_EQ(found.chosen->kernel, best->kernel) << budget;
            EXPECT_EQ(found.chosen->taps, best->taps) << budget;
        } else if (!best) {
            ++nothing;
            for (const choose::Relaxed& relaxed : found.relaxed) {
                EXPECT_GT(relaxed.factor(), 1.0);
                Limits wider = limits;
                (relaxed.limit == "max_error"  ? wider.max_error
                 : relaxed.limit == "max_cost" ? *wider.max_cost
                                               : *wider.max_bytes) = relaxed.to;
                EXPECT_TRUE(allowed(relaxed.fits, wider)) << budget << " " << relaxed.limit;
            }
        }
    }
    return nothing;
}

TEST(Search, AgreesWithAPlainLoopOverEveryKernelAndLength) {
    const int nothing = agree_with_a_plain_loop(names(), 0.02, 0.8);
    EXPECT_GT(nothing, 20);
    EXPECT_LT(nothing, 480);
}

// One that is known to be costly is tried at a short length first, and chosen where nothing else would do.
TEST(Search, ADearKernelIsChosenWhereNothingElseWillDo) {
    for (const std::vector<std::string>& few :
         {std::vector<std::string>{"exact"}, {"exact", "coarse"}, {"broken", "exact"}}) {
        const int nothing = agree_with_a_plain_loop(few, 0.02, 0.3);
        EXPECT_GT(nothing, 20);
        EXPECT_LT(nothing, 480);
    }
}

TEST(Search, SaysWhyEachKernelLost) {
    MadeErrors errors(kernels);
    MadeCosts costs(kernels);
    const Choice found = choose::choose(errors, costs, names(), {0.06, 800.0, {}}, 1, false);
    std::map<std::string, Standing> fates;
    for (const choose::Outcome& outcome : found.kernels) {
        fates[outcome.kernel] = outcome.standing;
    }
    EXPECT_EQ(fates["broken"], Standing::wrong);
    EXPECT_EQ(fates["coarsest"], Standing::inaccurate);
    EXPECT_EQ(fates["exact"], Standing::too_costly);
    EXPECT_EQ(fates["lucky"], Standing::chosen);
    EXPECT_EQ(fates["groups"], Standing::runner_up);
}

TEST(Search, AWrongAnswerNeverWins) {
    const std::map<std::string, Made> only = {{"broken", {0.0, 0.0, 0.5, 1.0, 1.0, false, "it is broken"}}};
    MadeErrors errors(only);
    MadeCosts costs(only);
    const Choice found = choose::choose(errors, costs, {"broken"}, {1.0, {}, {}}, 1, false);
    EXPECT_FALSE(found.chosen);
    EXPECT_EQ(found.kernels.at(0).why, "it is broken");
}

std::vector<choose::Case> row_of(const std::string& kernel, std::size_t first, std::size_t last) {
    std::vector<choose::Case> cases;
    for (std::size_t taps = first; taps <= last; ++taps) {
        cases.emplace_back(kernel, taps);
    }
    return cases;
}

// Code that goes in groups costs least at a group's end: the seven lengths behind the shortest are looked at.
TEST(Search, TheRestOfAGroupIsLookedAt) {
    Few few;
    few.ones["a"] = {20, [](std::size_t taps) { return cost_of(taps == 27 ? 50.0 : taps == 28 ? 10.0 : 100.0); }};
    const Choice found = few.choose({0.1, {}, {}});
    EXPECT_EQ(found.chosen->taps, 27U);
    EXPECT_EQ(few.asked, row_of("a", 20, 27));
    few.asked.clear();
    few.same_every_time = false;  // times are not compared so closely
    EXPECT_EQ(few.choose({0.1, {}, {}}).chosen->taps, 20U);
    EXPECT_EQ(few.asked, row_of("a", 20, 20));
    Few last;  // none is longer than the record
    last.ones["a"] = {longest - 2, [](std::size_t) { return cost_of(100.0); }};
    EXPECT_EQ(last.choose({0.1, {}, {}}).chosen->taps, longest - 2);
    EXPECT_EQ(last.asked, row_of("a", longest - 2, longest));
}

// By the rest of a group a cost may fall by 64 instructions, in software double by a tenth of the best as well.
TEST(Search, WhatCanNoMoreBecomeTheCheapestIsNotLookedAt) {
    for (const auto& [cost, costly, looked_at] : {std::tuple(1064.0, false, true), std::tuple(1065.0, false, false),
                                                  std::tuple(1164.0, true, true), std::tuple(1165.0, true, false)}) {
        Few few;
        few.ones["a"] = {50, [](std::size_t) { return cost_of(1000.0); }};
        few.ones["b"] = {50, [value = cost](std::size_t) { return cost_of(value); }, costly};
        EXPECT_EQ(few.choose({0.1, {}, {}}).chosen->kernel, "a");
        EXPECT_EQ(std::count(few.asked.begin(), few.asked.end(), choose::Case("b", 57)), looked_at ? 1 : 0) << cost;
    }
    // Where nothing fits so far the limit is what has to be met.
    for (const double cost : {564.0, 565.0}) {
        Few few;
        few.ones["a"] = {50, [&](std::size_t taps) { return cost_of(taps == 53 ? 500.0 : cost); }};
        EXPECT_EQ(few.choose({0.1, 500.0, {}}).chosen.has_value(), cost == 564.0) << cost;
    }
}

// What a kernel could do at most within the other limits is looked for among the lengths that it has.
TEST(Search, WhereNothingMeetsTheLimitNoLengthBeyondFullMemoryIsAsked) {
    Few few;
    few.full = 20;
    few.ones["a"] = {21, [](std::size_t taps) { return cost_of(10.0 * static_cast<double>(taps)); }};
    const Choice found = few.choose({0.1, 1000.0, {}});
    ASSERT_EQ(found.relaxed.size(), 1U);
    EXPECT_EQ(found.relaxed[0].limit, "max_error");
    EXPECT_EQ(found.relaxed[0].fits.taps, 20U);
    for (const auto& [kernel, taps] : few.asked) {
        EXPECT_LE(taps, 20U);
    }
}

// A costly kernel is measured at 64 taps first, and where it is longer and costlier there than what fits, nowhere else.
TEST(Search, ADearKernelIsTriedAtAShortLengthFirst) {
    const auto asked_of = [](double short_cost, std::size_t meets_from, const Limits& limits, bool fails = false) {
        Few few;
        few.ones["cheap"] = {390, [](std::size_t) { return cost_of(1000.0); }};
        few.ones["costly"] = {meets_from,
                              [=](std::size_t taps) {
                                  Cost cost = cost_of(taps <= 64 ? short_cost : 5000.0);
                                  cost.fault = fails ? "too long" : "";
                                  return cost;
                              },
                              true};
        (void)few.choose(limits);
        std::vector<std::size_t> asked;
        for (const auto& [kernel, taps] : few.asked) {
            if (kernel == "costly") {
                asked.push_back(taps);
            }
        }
        return asked;
    };
    using Lengths = std::vector<std::size_t>;
    EXPECT_EQ(asked_of(1001.0, 65, {0.1, {}, {}}), Lengths{64});
    EXPECT_EQ(asked_of(1000.0, 65, {0.1, {}, {}}), (Lengths{64, 65}));
    EXPECT_EQ(asked_of(900.0, 300, {0.1, {}, {}}), (Lengths{64, 300}));
    EXPECT_EQ(asked_of(3000.0, 64, {0.1, {}, {}}), Lengths{64});  // no longer than that
    EXPECT_EQ(asked_of(3000.0, 300, {0.1, {}, {}}, true), (Lengths{64, 300}));
    Few alone;
    alone.ones["costly"] = {300, [](std::size_t taps) { return cost_of(10.0 * static_cast<double>(taps)); }, true};
    EXPECT_EQ(alone.choose({0.1, 640.0, {}}).kernels.at(0).standing, Standing::too_costly);
    EXPECT_EQ(alone.choose({0.1, 640.0, {}}).kernels.at(0).already,
              std::nullopt);  // 640 are within the limit: measured
    EXPECT_EQ(alone.choose({0.1, 639.0, {}}).kernels.at(0).already->taps, 64U);
    EXPECT_EQ(alone.choose({0.1, 639.0, {}}).kernels.at(0).standing, Standing::too_costly);
    EXPECT_EQ(alone.choose({0.1, 3000.0, {}}).chosen->taps, 300U);
    Few beside;
    beside.ones["cheap"] = {20, [](std::size_t) { return cost_of(100.0); }};
    beside.ones["costly"] = alone.ones["costly"];
    EXPECT_EQ(beside.choose({0.1, {}, {}}).kernels.at(1).standing, Standing::costlier);
}

TEST(Search, EachFateHasItsReason) {
    Few few;
    few.ones["a"] = {20, [](std::size_t) { return cost_of(100.0, 50.0); }};
    few.ones["as good"] = {20, [](std::size_t) { return cost_of(110.0, 50.0); }};
    few.ones["beaten"] = {20, [](std::size_t) { return cost_of(120.0, 50.0); }};
    few.ones["broken"] = {20, [](std::size_t) {
                              Cost cost = cost_of(1.0, 1.0);
                              cost.fault = "other bits";
                              return cost;
                          }};
    few.ones["small"] = {20, [](std::size_t) { return cost_of(130.0, 49.0); }};
    few.ones["too costly"] = {20, [](std::size_t) { return cost_of(201.0, 50.0); }};
    few.ones["too large"] = {20, [](std::size_t) { return cost_of(90.0, 61.0); }};
    few.ones["vague"] = {1000, [](std::size_t) { return cost_of(1.0, 1.0); }};
    const Choice found = few.choose({0.1, 200.0, 60.0});
    EXPECT_EQ(found.chosen->kernel, "a");
    EXPECT_EQ(found.runner_up->kernel, "as good");
    EXPECT_FALSE(found.tie);
    EXPECT_TRUE(found.relaxed.empty());
    std::map<std::string, std::pair<Standing, std::string>> fates;
    for (const choose::Outcome& outcome : found.kernels) {
        fates[outcome.kernel] = {outcome.standing, outcome.why};
    }
    const std::map<std::string, std::pair<Standing, std::string>> expected = {
        {"a", {Standing::chosen, ""}},
        {"as good", {Standing::runner_up, ""}},
        {"beaten", {Standing::dominated, "by a"}},
        {"broken", {Standing::wrong, "other bits"}},
        {"small", {Standing::costlier, ""}},
        {"too costly", {Standing::too_costly, ""}},
        {"too large", {Standing::too_large, ""}},
        {"vague", {Standing::inaccurate, ""}}};
    EXPECT_EQ(fates, expected);
    EXPECT_EQ(few.choose({0.1, 201.0, 61.0}).chosen->kernel, "too large");  // exactly at the limits
    // Errors within one percent are the same: who errs less by that is dominated by who costs less.
    for (const auto& [factor, expected_standing] :
         {std::pair(1.009, Standing::dominated), std::pair(1.011, Standing::costlier)}) {
        const Candidate cheap{"cheap", 1, {factor * 1e-3, "step", {}}, cost_of(100.0, 50.0)};
        const Candidate costly{"costly", 1, {1e-3, "step", {}}, cost_of(120.0, 50.0)};
        EXPECT_EQ(choose::dominates(cheap, costly), expected_standing == Standing::dominated);
        EXPECT_FALSE(choose::dominates(costly, cheap));
    }
    // As good in each and better in none does not dominate.
    few.ones["beaten"] = few.ones["as good"] = few.ones["a"];
    for (const choose::Outcome& outcome : few.choose({0.1, 200.0, 60.0}).kernels) {
        EXPECT_NE(outcome.standing, Standing::dominated) << outcome.kernel;
    }
}

TEST(Search, WithinTheNoiseOfBothItIsATie) {
    for (const auto& [second, tie] : {std::pair(113.0, true), std::pair(113.5, false)}) {
        Few few;
        few.same_every_time = false;
        few.ones["a"] = {20, [](std::size_t) { return cost_of(100.0, 8.0, 3.0); }};
        few.ones["b"] = {20, [value = second](std::size_t) { return cost_of(value, 8.0, 10.0); }};
        EXPECT_EQ(few.choose({0.1, {}, {}}).tie, tie) << second;
    }
}

// Nothing fits: what each limit alone would have to be, the least relaxation first.
TEST(Relax, SaysWhatEachLimitAloneWouldHaveToBe) {
    Few few;
    few.ones["costly"] = {100, [](std::size_t taps) { return cost_of(10.0 * static_cast<double>(taps), 40.0); }};
    few.ones["large"] = {50, [](std::size_t taps) { return cost_of(60.0, 2.0 * static_cast<double>(taps)); }};
    const Choice found = few.choose({0.1, 500.0, 50.0});
    ASSERT_FALSE(found.chosen);
    ASSERT_EQ(found.relaxed.size(), 3U);
    EXPECT_EQ(found.relaxed[0].limit, "max_cost");
    EXPECT_EQ(found.relaxed[0].from, 500.0);
    EXPECT_EQ(found.relaxed[0].to, 1000.0);
    EXPECT_EQ(found.relaxed[0].fits.kernel, "costly");
    EXPECT_EQ(found.relaxed[0].fits.taps, 100U);
    EXPECT_EQ(found.relaxed[1].limit, "max_bytes");
    EXPECT_EQ(found.relaxed[1].to, 100.0);
    EXPECT_EQ(found.relaxed[1].fits.kernel, "large");
    EXPECT_EQ(found.relaxed[2].limit, "max_error");
    EXPECT_EQ(found.relaxed[2].to, 1.0);
    EXPECT_EQ(found.relaxed[2].factor(), 10.0);
    // Without limits on cost and bytes only the error can be relaxed.
    Few vague;
    vague.ones["a"] = {1000, [](std::size_t) { return cost_of(1.0); }};
    const Choice none = vague.choose({0.1, {}, {}});
    ASSERT_EQ(none.relaxed.size(), 1U);
    EXPECT_EQ(none.relaxed[0].limit, "max_error");
    EXPECT_EQ(none.relaxed[0].to, 1.0);
}

// A costly kernel that alone would do is measured where it does before a limit is named.
TEST(Relax, ADearKernelsCostIsThatOfTheLengthItNeeds) {
    Few few;
    few.ones["costly"] = {300, [](std::size_t taps) { return cost_of(10.0 * static_cast<double>(taps)); }, true};
    const Choice found = few.choose({0.1, 600.0, {}});
    ASSERT_EQ(found.relaxed.size(), 2U);
    EXPECT_EQ(found.relaxed[0].limit, "max_cost");
    EXPECT_EQ(found.relaxed[0].to, 3000.0);
    EXPECT_EQ(found.relaxed[0].fits.taps, 300U);
}

// The most accurate within the other limits is that of the longest length, found in few rounds where costs are
// straight.
TEST(Relax, TheLongestLengthWithinTheOtherLimitsIsFound) {
    const auto error_at = [](std::size_t taps) { return 1.0 / static_cast<double>(taps); };
    struct Falling : Few {
        [[nodiscard]] ErrorAt error(const std::string&, std::size_t taps) override {
            return {.error = 1.0 / static_cast<double>(taps), .signal = "made", .fault = {}};
        }
    };
    for (const std::size_t most : {1U, 2U, 3U, 31U, 32U, 33U, 100U, 250U, 399U, 400U}) {
        for (const bool by_bytes : {false, true}) {
            Falling few;
            few.ones["a"] = {1, [&](std::size_t taps) {
                                 const double rising = 7.0 + 5.0 * static_cast<double>(taps);
                                 return by_bytes ? cost_of(1.0, rising) : cost_of(rising, 1.0);
                             }};
            const double limit = 7.0 + 5.0 * static_cast<double>(most) + 1.0;
            const Choice found = few.choose(by_bytes ? Limits{1e-4, 2.0, limit} : Limits{1e-4, limit, 2.0});
            ASSERT_FALSE(found.chosen);
            ASSERT_EQ(found.relaxed.size(), 1U) << most;
            EXPECT_EQ(found.relaxed[0].limit, "max_error");
            EXPECT_EQ(found.relaxed[0].to, error_at(most)) << most << by_bytes;
            EXPECT_EQ(found.relaxed[0].fits.taps, most) << by_bytes;
            EXPECT_LE(few.rounds, 8U) << most << by_bytes;
        }
    }
    // A step in the costs: by halves it is found as well.
    Falling steep;
    steep.ones["a"] = {1, [](std::size_t taps) { return cost_of(taps <= 123 ? 10.0 : 1e6); }};
    EXPECT_EQ(steep.choose({1e-4, 50.0, {}}).relaxed.at(0).fits.taps, 123U);
    EXPECT_LE(steep.rounds, 24U);
    // Where nothing is within the other limits there is no relaxing the error.
    EXPECT_TRUE(steep.choose({1e-4, 9.0, {}}).relaxed.empty());
}

// Errors of kernels that share work, whose group is their first letter.
class GroupedErrors : public MadeErrors {
public:
    using MadeErrors::MadeErrors;
    [[nodiscard]] std::string group(const std::string& kernel) const override { return kernel.substr(0, 1); }
    [[nodiscard]] std::optional<std::vector<std::size_t>> lengths(const std::string& kernel) const override {
        asked.push_back(kernel);
        return std::vector<std::size_t>{1};
    }
    mutable std::vector<std::string> asked;
};

TEST(Search, ThreadsBeginWithKernelsThatShareNoWork) {
    std::map<std::string, Made> made;
    for (const char* name : {"a1", "a2", "a3", "b1", "c1", "c2"}) {
        made[name] = {1e-7, 0.3, 6.0, 1.0, 8.0};
    }
    GroupedErrors errors(made);
    MadeCosts costs(made);
    const Choice found = choose::choose(errors, costs, {"a1", "a2", "a3", "b1", "c1", "c2"}, {2.0, {}, {}}, 1, false);
    ASSERT_GE(errors.asked.size(), 6U);
    errors.asked.resize(6);
    EXPECT_EQ(errors.asked, (std::vector<std::string>{"a1", "b1", "c1", "a2", "c2", "a3"}));
    EXPECT_EQ(found.kernels[1].kernel, "a2");  // told in the order given
}

}  // namespace
