// Causes that go because the others do as well once they are fitted to the validation, too.
#include "gap/drive/superfluous.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "gap/drive/base/jointly.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/start.hpp"

namespace {

using gap::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;

// Levels of both signs, held for two seconds; drag brakes.
gap::Record braked(unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 2e-3);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 0.1;
    for (int i = 0; i < 400; ++i) {
        record.time_s.push_back(0.1 * i);
        record.input.push_back(i % 20 == 0 ? even(engine) : record.input.back());
        record.output.push_back(0.0);
    }
    gap::Scenario scenario;
    scenario.model = drive::make_sopdt(2.0, 0.5, 0.0);
    gap::effect_named("quadratic_drag").add_to(scenario, std::vector{0.8, 0.0});
    record.output = gap::simulate(scenario, gap::Course(record, 4));
    for (double& z : record.output) {
        z += noise(engine);
    }
    return record;
}

// Training told drag by a half only, say, and a disturbance goes as far as is said.
class Superfluous : public testing::Test {
protected:
    Superfluous() {
        question_.find = true;
        const gap::Effect& drag = gap::effect_named("quadratic_drag");
        const gap::Effect& load = gap::effect_named("load_disturbance");
        gap::Ranked none;
        none.trained = gap::fit(ground_.study, {}, ground_.base, nullptr);
        none.gap_after = 0.5;
        gap::Ranked one;
        one.trained = gap::fit(ground_.study, {&drag}, none.trained, nullptr);
        one.trained.lasting[0][0].value *= 0.5;
        one.gap_after = 0.2;
        gap::Ranked both = one;
        both.trained = gap::fit(ground_.study, {&drag, &load}, one.trained, nullptr, {0, 1, 0});
        for (gap::Ranked* ranked : {&none, &one, &both}) {
            ranked->candidate = gap::carried_over(ground_.validation, ranked->trained, nullptr);
            ranked->residuals = gap::all_residuals(ground_.validation, ranked->candidate);
            ranking_.push_back(*ranked);
        }
    }

    // \param left  by both causes
    gap::Decision after(double left) {
        ranking_[2].gap_after = left;
        gap::Decision decision = attributed(2);
        drop(decision);
        return decision;
    }

    static gap::Decision attributed(std::size_t chosen) {
        gap::Decision decision;
        decision.outcome = Outcome::attributed;
        decision.chosen = chosen;
        decision.effects = {chosen};
        decision.base_gap = 0.5;
        decision.confidence = 0.9;
        return decision;
    }

    void drop(gap::Decision& decision) {
        gap::drop_superfluous(question_, ground_, ranking_, gap::whitener_of(ground_.study, ranking_[1].trained),
                              decision);
    }

    gap::Question question_{gap::form_of(drive::make_sopdt(2.0, 0.5, 0.0)),
                            true,
                            {braked(1)},
                            {braked(2)},
                            {},
                            gap::Metric::simulation,
                            {},
                            1};
    gap::Ground ground_ = gap::prepare(question_);
    std::vector<gap::Ranked> ranking_;
};

TEST_F(Superfluous, GoesWhatTheOthersDoTogether) {
    const double noise = 2e-3 / gap::output_deviation(ground_.validation);
    gap::Decision decision = after(0.95 * noise);
    EXPECT_EQ(decision.outcome, Outcome::attributed);
    EXPECT_THAT(decision.effects, ElementsAre(1U));
    EXPECT_EQ(decision.chosen, 1U);
    EXPECT_EQ(decision.confidence, 0.8);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("quadratic_drag leaves")));
    // What goes farther is none of its numbers.
    decision = after(0.75 * noise);
    EXPECT_THAT(decision.effects, ElementsAre(2U));
    EXPECT_EQ(decision.confidence, 0.9);
    // Of a form that was asked for it may be the form's own misfit.
    question_.find = false;
    EXPECT_THAT(after(0.95 * noise).effects, ElementsAre(2U));
}

// Fifteen per cent more than both leave is as far.
TEST_F(Superfluous, IsWhatLeavesFifteenPercentMoreAtMost) {
    const double jointly = gap::joint_gap(question_, ranking_[1]);
    EXPECT_THAT(after(jointly / 1.144).effects, ElementsAre(1U));
    EXPECT_THAT(after(jointly / 1.156).effects, ElementsAre(2U));
}

// A cause that stands alone stays.
TEST_F(Superfluous, IsNoCauseThatStandsAlone) {
    gap::Decision decision = attributed(1);
    drop(decision);
    EXPECT_EQ(decision.chosen, 1U);
    EXPECT_THAT(decision.effects, ElementsAre(1U));
    EXPECT_EQ(decision.confidence, 0.9);
    EXPECT_TRUE(decision.notes.empty());
}

// Of alternatives what they share does as well, or all of them stay.
TEST_F(Superfluous, IsWhatAlternativesDifferBy) {
    ranking_[2].gap_after = 0.2;
    const auto beside = [&](const char* one, const char* other) {
        ranking_.resize(3);
        ranking_.push_back(ranking_[2]);
        ranking_[3].trained.effects = {&gap::effect_named(one), &gap::effect_named(other)};
        gap::Decision decision = attributed(2);
        decision.outcome = Outcome::ambiguous;
        decision.effects = {2, 3};
        drop(decision);
        return decision;
    };
    const gap::Decision shared = beside("gain_drift", "quadratic_drag");
    EXPECT_EQ(shared.outcome, Outcome::attributed);
    EXPECT_THAT(shared.effects, ElementsAre(1U));
    EXPECT_EQ(shared.confidence, 0.8);
    const gap::Decision stays = beside("gain_drift", "load_disturbance");
    EXPECT_EQ(stays.outcome, Outcome::ambiguous);
    EXPECT_THAT(stays.effects, ElementsAre(2U, 3U));
}

}  // namespace
