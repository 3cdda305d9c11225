// What candidates are ranked by: likelihood less what chance would gain, each in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "gap/drive/ranking.hpp"
#include "gap/drive/start.hpp"

namespace {

struct Made {
    std::vector<gap::Record> records;
    gap::Study study;
    explicit Made(std::size_t count = 1, bool refit = false)
        : study{{gap::form_of(drive::make_fopdt(2.0, 3.0, 0.0)), refit}, {}, {}, {}, 0.01, 0.004, 0} {
        gap::Record record;
        record.name = "made";
        record.usual_interval_s = 0.5;
        for (std::size_t i = 0; i < 100; ++i) {
            record.time_s.push_back(0.5 * static_cast<double>(i));
            record.input.push_back(i < 50 ? 0.0 : 1.0);
            record.output.push_back(i % 2 == 0 ? 1.0 : -1.0);
        }
        records.assign(count, record);
        study.counts = gap::all_count(records);
        study.scales = gap::scales_of(gap::model_of(study.base.form), records, {});
        for (const gap::Record& one : records) {
            study.courses.emplace_back(one, 1);
        }
    }
};

gap::Ranked ranked(const Made& made, double residual) {
    gap::Ranked one;
    one.residuals.assign(made.records.size(), std::vector<double>(100, residual));
    one.candidate.own.resize(made.records.size());
    return one;
}

gap::Whitener white() {
    gap::Whitener whitener;
    whitener.deviation = whitener.stationary_deviation = 0.5;
    return whitener;
}

double student(double size) { return -3.0 * std::log(1.0 + size * size / 3.0) - std::log(0.5); }

TEST(Likelihood, IsThatOfWhatIsLeft) {
    const Made made;
    gap::Ranked one = ranked(made, 0.25);
    gap::judge(one, made.study, white());
    EXPECT_EQ(one.by_sample.size(), 100U);
    EXPECT_NEAR(one.log_likelihood, 100.0 * student(0.5), 1e-9);
    EXPECT_NEAR(one.gap_after, 0.25, 1e-12);  // the readings' deviation is 1
    // Of none 24 blocks' size of what is slow, over the output's deviation.
    EXPECT_NEAR(one.penalty, 24.0 * std::log(0.25), 1e-9);
    EXPECT_NEAR(one.score(), one.log_likelihood - one.penalty, 1e-12);
}

TEST(Likelihood, PaysForNumbersWhatChanceGains) {
    const double chance = std::log(200.0);
    const Made made(2);
    gap::Ranked one = ranked(made, 0.25);
    gap::judge(one, made.study, white());
    const double none = one.penalty;
    // Two numbers of one lasting effect: 2 each, and 2 for the effect.
    one.candidate.effects = {&gap::effect_named("supply_sag")};
    one.candidate.lasting = {gap::parameters_of(*one.candidate.effects[0], made.study.scales, 0)};
    gap::judge(one, made.study, white());
    EXPECT_NEAR(one.penalty - none, 2.0 * 3.0, 1e-9);
    // An event's three numbers are fitted in both records that judge, and its place was searched for in both.
    gap::Ranked event = ranked(made, 0.25);
    event.candidate.effects = {&gap::effect_named("load_disturbance")};
    for (auto& own : event.candidate.own) {
        own = gap::parameters_of(*event.candidate.effects[0], made.study.scales, 0);
    }
    gap::judge(event, made.study, white());
    EXPECT_NEAR(event.penalty - none, 0.5 * chance * 6.0 + 2.0 * chance + 2.0 * 4.0, 1e-9);
    // And so are numbers of its lasting effects that were settled there.
    event.settled = 2;
    gap::judge(event, made.study, white());
    EXPECT_NEAR(event.penalty - none, 0.5 * chance * 8.0 + 2.0 * chance + 2.0 * 4.0, 1e-9);
}

// No reading tells more than which step it fell on.
TEST(Likelihood, IsNoFinerThanTheQuantum) {
    Made made;
    made.study.scales.quantum = 4.0;
    gap::Ranked one = ranked(made, 0.0);
    gap::judge(one, made.study, white());
    constexpr double constant = 0.713;  // of Student's density, which is left out
    EXPECT_NEAR(one.log_likelihood, 100.0 * (constant - std::log(4.0)), 1e-9);
    EXPECT_NEAR(one.penalty, 24.0 * std::log(0.29 * 4.0), 1e-9);
    // A candidate that says within which step each reading lies has its mass there: all of it where none misses.
    one.candidate.effects = {&gap::effect_named("encoder_quantisation")};
    one.candidate.lasting = {{}};
    gap::judge(one, made.study, white());
    EXPECT_NEAR(one.penalty, 24.0 * std::log(0.05 * 4.0) + 2.0, 1e-9);
}

// Between the steps' edges nothing is missed; beyond them as much as noise of the best size makes. Where few miss by
// much the noise is small, and large where many do; what it takes away from those within counts, too.
TEST(Likelihood, OfSteppedReadingsIsTheMassBeyondTheStep) {
    Made made;
    constexpr double step = 2.0;
    made.study.scales.quantum = step;
    gap::Ranked one = ranked(made, 0.0);
    one.candidate.effects = {&gap::effect_named("encoder_quantisation")};
    one.candidate.lasting = {{}};
    std::set<double> chosen;
    for (const std::size_t missing : {0U, 2U, 3U, 4U, 5U, 40U, 99U}) {
        for (const double steps : {0.05, 0.1, 0.3, 1.0, 1.2}) {
            // And one by more: what misses by less than an eighth of a step altogether is judged as other residuals.
            std::vector<double> outside(100, 0.0);
            std::fill_n(outside.begin(), missing, steps);
            outside.back() = missing == 4 ? 2.0 : 1.3;
            double best = -1e300;
            double best_share = 0.0;
            for (const double share : {0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 8.0}) {
                double sum = 0.0;
                for (const double miss : outside) {
                    const double mass = miss == 0.0 ? std::max(0.5, 1.0 - 0.8 * share)
                                                    : 0.5 * std::erfc(miss / (share * std::sqrt(2.0)));
                    sum += std::log(std::max(1e-9, mass) / step) + 0.713;
                }
                best_share = sum > best ? share : best_share;
                best = std::max(best, sum);
            }
            chosen.insert(best_share);
            for (std::size_t i = 0; i < 100; ++i) {
                one.residuals[0][i] = outside[i] * step;
            }
            gap::judge(one, made.study, white());
            EXPECT_NEAR(one.log_likelihood, best, 1e-6) << missing << " by " << steps;
        }
    }
    EXPECT_EQ(chosen.size(), 7U);  // each size of noise has its turn
}

// What misses by many steps is as likely with its steps as without: a mass that is too small to tell would be a floor.
TEST(Likelihood, OfManyStepsIsNoRoundings) {
    Made made;
    constexpr double step = 0.002;
    made.study.scales.quantum = step;
    for (const double steps : {7.9, 8.1}) {
        gap::Ranked plain = ranked(made, steps * step);
        gap::judge(plain, made.study, white());
        gap::Ranked stepped = plain;
        stepped.candidate.effects = {&gap::effect_named("encoder_quantisation")};
        stepped.candidate.lasting = {{}};
        gap::judge(stepped, made.study, white());
        EXPECT_EQ(stepped.log_likelihood == plain.log_likelihood, steps > 8.0) << steps;
    }
}

// What a fitted form leaves is slow: its size is the evidence, as often as there is anything new in it.
TEST(Likelihood, OfASlowMisfitGoesByItsSize) {
    const Made made(1, true);
    gap::Whitener slow = white();
    slow.stationary_deviation = 4.01 * slow.deviation;
    slow.coefficients = {0.99};
    gap::Ranked one = ranked(made, 0.25);
    const auto expected = [](double share) { return 100.0 * -share * (std::log(0.25) + 0.5); };
    slow.samples_apart = 2.0;
    gap::judge(one, made.study, slow);
    EXPECT_NEAR(one.log_likelihood, expected(0.5), 1e-9);
    EXPECT_NEAR(one.penalty, 0.0, 1e-9);
    slow.samples_apart = 10.0;  // 24 times at least
    gap::judge(one, made.study, slow);
    EXPECT_NEAR(one.log_likelihood, expected(0.24), 1e-9);
    slow.samples_apart = 1.0;
    gap::judge(one, made.study, slow);
    EXPECT_NEAR(one.log_likelihood, expected(1.0), 1e-9);
    // Beside a given model it is whitened, however slow.
    const Made given;
    gap::judge(one, given.study, slow);
    EXPECT_NEAR(one.by_sample[5], -3.0 * std::log(1.0 + std::pow(0.25 * 0.01 / 0.5, 2) / 3.0) - std::log(0.5), 1e-9);
}

TEST(Likelihood, OfWhatRanAwayIsFinite) {
    const Made made;
    gap::Ranked one = ranked(made, std::nan(""));
    gap::judge(one, made.study, white());
    EXPECT_EQ(one.gap_after, gap::Ranked::ran_away);
    EXPECT_EQ(one.by_sample.front(), -1e6);
    EXPECT_NEAR(one.penalty, 24.0 * std::log(1e6), 1e-6);
}

TEST(Advantage, IsTheDifferenceOfScoresWithItsBounds) {
    gap::Ranked a;
    gap::Ranked b;
    a.by_sample.assign(80, 0.5);
    b.by_sample.assign(80, 0.25);
    a.penalty = 7.0;
    b.penalty = 3.0;
    const gap::Interval over = gap::advantage(a, b);
    EXPECT_NEAR(over.mean, 16.0, 1e-9);
    EXPECT_NEAR(over.low, 16.0, 1e-9);
    EXPECT_NEAR(over.high, 16.0, 1e-9);
    // One half that gains and another one that loses: blocks of a fortieth are drawn again.
    for (std::size_t i = 0; i < 40; ++i) {
        a.by_sample[i] = 1.25;
    }
    const gap::Interval wide = gap::advantage(a, b);
    EXPECT_NEAR(wide.mean, 46.0, 1e-9);
    EXPECT_NEAR(0.5 * (wide.high - wide.low), 1.645 * 2.0 * 0.375 * std::sqrt(40.0), 1.2);
    // What comes again in each fortieth of the samples is in each block, and no chance is left.
    a = b = {};
    for (int i = 0; i < 1600; ++i) {
        a.by_sample.push_back(i % 40 < 20 ? 1.0 : -1.0);
    }
    b.by_sample.assign(1600, 0.0);
    const gap::Interval again = gap::advantage(a, b);
    EXPECT_NEAR(again.low, 0.0, 1e-9);
    EXPECT_NEAR(again.high, 0.0, 1e-9);
}

TEST(WhitenerOf, IsOfWhatCounts) {
    Made made;
    gap::Candidate none;
    none.own.resize(1);
    for (std::size_t i = 0; i < 50; ++i) {
        made.records[0].output[i] = 9.0;  // far off
        made.study.counts[0][i] = 0;
    }
    for (std::size_t i = 50; i < 100; ++i) {
        made.records[0].output[i] = i % 2 == 0 ? 0.1 : -0.1;
    }
    std::fill(made.records[0].input.begin(), made.records[0].input.end(), 0.0);
    made.study.courses.clear();
    made.study.courses.emplace_back(made.records[0], 1);
    EXPECT_NEAR(gap::whitener_of(made.study, none).stationary_deviation, 0.1, 1e-6);
}

// Numbers that the validation told cost what those of events do.
TEST(Likelihood, PaysForWhatTheValidationSettled) {
    const Made made;
    gap::Candidate candidate;
    candidate.own.resize(1);
    const auto ranked_with = [&](std::size_t settled) {
        return gap::validated(made.study, candidate, white(), nullptr, true, settled);
    };
    EXPECT_EQ(ranked_with(2).settled, 2U);
    EXPECT_NEAR(ranked_with(2).penalty - ranked_with(0).penalty, 2.0 * 0.5 * std::log(100.0), 1e-9);
}

}  // namespace
