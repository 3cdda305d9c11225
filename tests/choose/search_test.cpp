// The search on made-up kernels: errors that are not monotone, costs that fall at group ends, against a plain loop.
#include "bench/choose/search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using choose::Candidate;
using choose::Choice;
using choose::Cost;
using choose::ErrorAt;
using choose::Fate;
using choose::Limits;

struct Made {
    double rounding;  // at one tap; grows with the root of the length; below 0 it makes good what truncation costs
    double wobble;    // of the error, relative
    double per_tap;
    double group;  // taps that cost the same
    double bytes_per_tap;
    bool dear = false;
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
    [[nodiscard]] bool dear(const std::string& kernel) const override { return kernels_.at(kernel).dear; }
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

// One that is known to be dear is tried at a short length first, and chosen where nothing else would do.
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
    std::map<std::string, Fate> fates;
    for (const choose::Fared& fared : found.kernels) {
        fates[fared.kernel] = fared.fate;
    }
    EXPECT_EQ(fates["broken"], Fate::wrong);
    EXPECT_EQ(fates["coarsest"], Fate::inaccurate);
    EXPECT_EQ(fates["exact"], Fate::too_dear);
    EXPECT_EQ(fates["lucky"], Fate::chosen);
    EXPECT_EQ(fates["groups"], Fate::runner_up);
}

TEST(Search, AWrongAnswerNeverWins) {
    const std::map<std::string, Made> only = {{"broken", {0.0, 0.0, 0.5, 1.0, 1.0, false, "it is broken"}}};
    MadeErrors errors(only);
    MadeCosts costs(only);
    const Choice found = choose::choose(errors, costs, {"broken"}, {1.0, {}, {}}, 1, false);
    EXPECT_FALSE(found.chosen);
    EXPECT_EQ(found.kernels.at(0).why, "it is broken");
}

}  // namespace
