// When nothing fits: which lengths are measured to say how far a limit would have to give way, and what is said.
#include "bench/choose/relax.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using choose::Candidate;
using choose::Cost;
using choose::Outcome;
using choose::Relaxed;
using choose::Standing;
using Cases = std::vector<choose::Case>;

// Errors that fall with the length and costs that rise with it, where a test does not say otherwise; and what was
// asked.
struct Given : choose::ErrorSource, choose::CostSource {
    std::size_t full = 400;
    std::function<choose::ErrorAt(const std::string&, std::size_t)> error_at = [](const std::string&,
                                                                                  std::size_t taps) {
        return choose::ErrorAt{.error = 1.0 / static_cast<double>(taps), .signal = "made", .fault = {}};
    };
    std::function<Cost(const std::string&, std::size_t)> cost_at = [](const std::string&, std::size_t taps) {
        const double rising = 10.0 * static_cast<double>(taps);
        return Cost{.value = rising, .limited = rising, .noise = 0.0, .bytes = 2.0 * rising, .fault = {}};
    };
    Cases asked;

    [[nodiscard]] std::size_t longest() const override { return full; }
    [[nodiscard]] double truncation(std::size_t) const override { return 0.0; }
    [[nodiscard]] double rounding_bound(const std::string&, std::size_t) const override { return 0.0; }
    [[nodiscard]] choose::ErrorAt error(const std::string& kernel, std::size_t taps) override {
        return error_at(kernel, taps);
    }
    [[nodiscard]] bool meets(const std::string& kernel, std::size_t taps, double limit) override {
        return error_at(kernel, taps).error <= limit;
    }
    [[nodiscard]] std::string unit() const override { return "instructions"; }
    [[nodiscard]] std::string limited_unit() const override { return "instructions"; }
    [[nodiscard]] bool exact() const override { return true; }
    [[nodiscard]] std::vector<Cost> costs(const Cases& cases) override {
        std::vector<Cost> found;
        for (const auto& [kernel, taps] : cases) {
            asked.emplace_back(kernel, taps);
            found.push_back(cost_at(kernel, taps));
        }
        return found;
    }
    [[nodiscard]] std::vector<std::size_t> lengths_asked() const {
        std::vector<std::size_t> all;
        for (const auto& [kernel, taps] : asked) {
            all.push_back(taps);
        }
        return all;
    }
};

Outcome inaccurate(const std::string& kernel) {
    Outcome made;
    made.kernel = kernel;
    made.standing = Standing::inaccurate;
    return made;
}

Candidate candidate(const std::string& kernel, std::size_t taps, double limited, double bytes) {
    return {kernel,
            taps,
            {.error = 0.01, .signal = "made", .fault = {}},
            {.value = limited, .limited = limited, .noise = 0.0, .bytes = bytes, .fault = {}}};
}

// One that meets the error, beyond another limit.
Outcome beyond(const std::string& kernel, double limited, double bytes) {
    Outcome made;
    made.kernel = kernel;
    made.standing = Standing::too_costly;
    made.best = candidate(kernel, 10, limited, bytes);
    return made;
}

std::vector<Relaxed> relaxed_of(Given& given, const choose::Limits& limits, std::vector<Outcome> kernels) {
    return choose::relax(given, given, limits, kernels);
}

using Lengths = std::vector<std::size_t>;

// Each length lies between the longest within the limits and the shortest that is not, every third halfway. At last
// nothing lies between, and what is left is measured as the answer.
void expect_narrowing(const Lengths& asked, std::size_t fails, std::size_t longest_within) {
    std::size_t fits = 0;
    for (std::size_t i = 0; i + 1 < asked.size(); ++i) {
        EXPECT_GT(asked[i], fits) << i;
        EXPECT_LT(asked[i], fails) << i;
        if (i % 3 == 2) {
            EXPECT_EQ(asked[i], fits + (fails - fits) / 2) << i;
        }
        (asked[i] <= longest_within ? fits : fails) = asked[i];
    }
    EXPECT_EQ(fails, fits + 1);
    EXPECT_EQ(asked.back(), fits);
}

// 32 taps first, then in proportion to what the last length cost, every third time halfway; the answer at last.
TEST(RelaxSearch, GoesInProportionAndByHalves) {
    Given by_cost;
    const auto found = relaxed_of(by_cost, {1e-4, 1000.0, {}}, {inaccurate("a")});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].limit, "max_error");
    EXPECT_EQ(found[0].from, 1e-4);
    EXPECT_EQ(found[0].to, 0.01);
    EXPECT_EQ(found[0].fits.taps, 100U);
    EXPECT_EQ(found[0].fits.cost.limited, 1000.0);
    // 32 cost 320, so 100 cost 1000; halfway to 401 lies 250, which is beyond; 100 once more, but 101 is the least.
    EXPECT_EQ(by_cost.lengths_asked(), (Lengths{32, 100, 250, 101, 100}));
    Given by_bytes;
    EXPECT_EQ(relaxed_of(by_bytes, {1e-4, {}, 2000.0}, {inaccurate("a")}).at(0).fits.taps, 100U);
    EXPECT_EQ(by_bytes.lengths_asked(), (Lengths{32, 100, 250, 101, 100}));
    // Of two limits the nearer one: 1000 bytes are 50 taps.
    Given by_both;
    EXPECT_EQ(relaxed_of(by_both, {1e-4, 1000.0, 1000.0}, {inaccurate("a")}).at(0).fits.taps, 50U);
    EXPECT_EQ(by_both.lengths_asked(), (Lengths{32, 50, 225, 51, 50}));
}

TEST(RelaxSearch, StaysWithinTheRecord) {
    Given brief;
    brief.full = 20;
    EXPECT_EQ(relaxed_of(brief, {1e-4, 1000.0, {}}, {inaccurate("a")}).at(0).fits.taps, 20U);
    EXPECT_EQ(brief.lengths_asked(), (Lengths{10, 20, 20}));
    // What fits almost exactly leaves the next length to try.
    Given exactly;
    EXPECT_EQ(relaxed_of(exactly, {1e-4, 325.0, {}}, {inaccurate("a")}).at(0).fits.taps, 32U);
    EXPECT_EQ(exactly.lengths_asked(), (Lengths{32, 33, 32}));
    // A record of one sample has one length.
    Given shortest;
    shortest.full = 1;
    EXPECT_EQ(relaxed_of(shortest, {1e-4, 10.0, {}}, {inaccurate("a")}).at(0).fits.taps, 1U);
    EXPECT_EQ(shortest.lengths_asked(), (Lengths{1, 1}));
    EXPECT_TRUE(relaxed_of(shortest, {1e-4, 9.0, {}}, {inaccurate("a")}).empty());
}

// A length whose answer is wrong is none, however little it costs.
TEST(RelaxSearch, AFaultIsBeyondEveryLimit) {
    Given broken;
    const auto rising = broken.cost_at;
    broken.cost_at = [&](const std::string& kernel, std::size_t taps) {
        Cost cost = rising(kernel, taps);
        cost.fault = taps > 50 ? "too long" : "";
        return cost;
    };
    EXPECT_EQ(relaxed_of(broken, {1e-4, 1000.0, {}}, {inaccurate("a")}).at(0).fits.taps, 50U);
    expect_narrowing(broken.lengths_asked(), 401, 50);
    Given without_answer;
    without_answer.error_at = [](const std::string& kernel, std::size_t) {
        return choose::ErrorAt{
            .error = kernel == "a" ? 0.0 : 0.5, .signal = {}, .fault = kernel == "a" ? "broken" : ""};
    };
    const auto found = relaxed_of(without_answer, {1e-4, 1000.0, {}}, {inaccurate("a"), inaccurate("b")});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].fits.kernel, "b");
    // Known to be wrong, it is not even asked.
    Given wrong;
    Outcome of_wrong = inaccurate("a");
    of_wrong.standing = Standing::wrong;
    EXPECT_TRUE(relaxed_of(wrong, {1e-4, 1000.0, {}}, {of_wrong}).empty());
    EXPECT_TRUE(wrong.asked.empty());
}

// Of kernels that err as much, cost as much and are as large the first is named.
TEST(Relax, OfEqualsTheFirstIsNamed) {
    Given given;
    const auto found = relaxed_of(given, {0.1, 50.0, 40.0}, {beyond("a", 100.0, 40.0), beyond("b", 100.0, 40.0)});
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].limit, "max_cost");
    EXPECT_EQ(found[0].fits.kernel, "a");
    Given large;
    const auto bytes = relaxed_of(large, {0.1, 50.0, 40.0}, {beyond("a", 50.0, 80.0), beyond("b", 50.0, 80.0)});
    ASSERT_FALSE(bytes.empty());
    EXPECT_EQ(bytes[0].limit, "max_bytes");
    EXPECT_EQ(bytes[0].fits.kernel, "a");
    Given vague;
    EXPECT_EQ(relaxed_of(vague, {1e-4, 1000.0, {}}, {inaccurate("a"), inaccurate("b")}).at(0).fits.kernel, "a");
}

// Each limit is relaxed where the others are kept, exactly at them too; as little as each the order is cost, bytes,
// error.
TEST(Relax, KeepsTheOtherLimits) {
    Given given;
    given.error_at = [](const std::string&, std::size_t) {
        return choose::ErrorAt{.error = 0.5, .signal = "made", .fault = {}};
    };
    const std::vector<Outcome> kernels = {beyond("costly", 100.0, 40.0), beyond("cheaper and too large", 90.0, 41.0),
                                          beyond("large", 50.0, 80.0), beyond("smaller and too costly", 51.0, 60.0)};
    const auto found = relaxed_of(given, {0.25, 50.0, 40.0}, kernels);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].limit, "max_cost");
    EXPECT_EQ(found[0].fits.kernel, "costly");
    EXPECT_EQ(found[0].factor(), 2.0);
    EXPECT_EQ(found[1].limit, "max_bytes");
    EXPECT_EQ(found[1].fits.kernel, "large");
    EXPECT_EQ(found[1].factor(), 2.0);
    EXPECT_EQ(found[2].limit, "max_error");
    EXPECT_EQ(found[2].factor(), 2.0);
}

// A kernel whose cost is a fault relaxes nothing.
TEST(Relax, AFaultyCostIsNoOffer) {
    Given given;
    Outcome broken = beyond("broken", 60.0, 40.0);
    broken.best->cost.fault = "other bits";
    const auto found = relaxed_of(given, {0.1, 50.0, 40.0}, {broken, beyond("right", 100.0, 40.0)});
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front().limit, "max_cost");
    EXPECT_EQ(found.front().fits.kernel, "right");
}

// What was too costly at a short length is measured where it would do, if nothing else meets the error.
TEST(Relax, WhatWasTooCostlyAlreadyIsMeasuredOnlyWhereItAloneWouldDo) {
    const auto too_costly = [] {
        Outcome made = beyond("dear", 0.0, 0.0);
        made.best->cost = {};
        made.best->taps = 300;
        made.already = candidate("dear", 64, 640.0, 1.0);
        return made;
    };
    const auto from_300_on = [](const std::string&, std::size_t taps) {
        return choose::ErrorAt{.error = taps >= 300 ? 0.01 : 1.0, .signal = "made", .fault = {}};
    };
    Given alone;
    alone.error_at = from_300_on;
    const auto found = relaxed_of(alone, {0.1, 600.0, {}}, {too_costly()});
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(alone.asked.front(), choose::Case("dear", 300));
    EXPECT_EQ(found[0].limit, "max_cost");
    EXPECT_EQ(found[0].to, 3000.0);
    EXPECT_EQ(found[1].limit, "max_error");
    Given beside;
    beside.error_at = from_300_on;
    const auto other = relaxed_of(beside, {0.1, 600.0, {}}, {too_costly(), beyond("b", 700.0, 1.0)});
    ASSERT_EQ(other.size(), 2U);
    EXPECT_NE(beside.asked.front(), choose::Case("dear", 300));
    EXPECT_EQ(other[0].limit, "max_cost");
    EXPECT_EQ(other[0].fits.kernel, "b");
    EXPECT_EQ(other[0].to, 700.0);
}

// Without other limits the best length that was measured is what there is; one that breaks another limit is not.
TEST(Relax, TheBestMeasuredLengthCountsWhereItKeepsTheOtherLimits) {
    Outcome short_of = inaccurate("a");
    short_of.short_of = candidate("a", 70, 0.0, 0.0);
    Given without;
    const auto found = relaxed_of(without, {1e-4, {}, {}}, {short_of});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].fits.taps, 70U);
    EXPECT_EQ(without.lengths_asked(), Lengths{70});
    // However much better another length might be, it was not measured.
    Given others_better;
    others_better.error_at = [](const std::string&, std::size_t taps) {
        return choose::ErrorAt{.error = taps == 70 ? 0.25 : 0.125, .signal = "made", .fault = {}};
    };
    EXPECT_EQ(relaxed_of(others_better, {1e-4, {}, {}}, {short_of}).at(0).to, 0.25);
    // 70 taps cost 700.
    Given shorter;
    EXPECT_EQ(relaxed_of(shorter, {1e-4, 600.0, {}}, {short_of}).at(0).fits.taps, 60U);
    // Where errors rise again with the length, the best measured one is better than the longest.
    Given rising;
    rising.error_at = [](const std::string&, std::size_t taps) {
        return choose::ErrorAt{.error = taps == 70 ? 0.25 : 0.5, .signal = "made", .fault = {}};
    };
    const auto best = relaxed_of(rising, {1e-4, 1000.0, {}}, {short_of});
    ASSERT_EQ(best.size(), 1U);
    EXPECT_EQ(best[0].to, 0.25);
    EXPECT_EQ(relaxed_of(rising, {1e-4, 690.0, {}}, {short_of}).at(0).to, 0.5);
}

}  // namespace
