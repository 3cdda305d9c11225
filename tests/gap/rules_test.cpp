// Each rule of the decision by itself, at its threshold, on rankings made by hand.
#include "gap/drive/decide/rule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "gap/drive/question.hpp"
#include "stand_case.hpp"

namespace {

using gap::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

// A linear stand that is simulated well; what candidates leave of it and how likely they are is said.
class Rules : public testing::Test {
protected:
    Rules() : question_(gap_test::question_of({}, {.seed = 31}, {.seed = 32})), ground_(gap::prepare(question_)) {
        set_noise(1.0);
        add({}, 1.0, 0.0);
    }

    // Readings that differ by so much from sample to sample, over their deviation.
    void set_noise(double share) {
        ground_.validation.noise = share * gap::output_deviation(ground_.validation);
        ground_.validation.least_deviation = 0.0;
    }

    /// \param advantage  over none, in every sample alike \returns its place in the ranking
    std::size_t add(const std::vector<std::string>& effects, double gap_after, double advantage) {
        gap::Ranked ranked;
        for (const std::string& name : effects) {
            const gap::Effect& effect = gap::effect_named(name);
            ranked.trained.effects.push_back(&effect);
            if (effect.kind == gap::Kind::lasting) {
                ranked.trained.lasting.push_back(gap::parameters_of(effect, ground_.study.scales, 0));
            }
        }
        ranked.trained.own.push_back(gap::state_of(ground_.study, ground_.study.courses[0].record()));
        ranked.candidate = ranked.trained;
        ranked.gap_after = gap_after;
        ranked.by_sample.assign(samples, advantage / samples);
        ranked.log_likelihood = advantage;
        ranked.residuals = {std::vector<double>(ground_.validation.courses[0].record().size(), 0.0)};
        ranking_.push_back(std::move(ranked));
        const std::size_t at = ranking_.size() - 1;
        known_.objections[at] = "";
        known_.remainders[at] = {};
        return at;
    }

    gap::Evidence evidence() const { return {ranking_, whitener_, ground_.study, ground_.validation, false, known_}; }
    gap::Decision after(const char* rule, gap::Decision before = {}) const {
        gap::rule_named(rule).apply(evidence(), before);
        return before;
    }
    static gap::Decision attributed(std::size_t at, double base_gap = 1.0) {
        gap::Decision decision;
        decision.outcome = Outcome::attributed;
        decision.effects = {at};
        decision.chosen = at;
        decision.base_gap = decision.noise_floor = base_gap;
        decision.confidence = 0.97;
        return decision;
    }
    void beside_a_form() {
        ground_.study.base.refit = ground_.validation.base.refit = true;
        for (gap::Ranked& ranked : ranking_) {
            ranked.trained.base = gap::base_of(ground_.study);
            ranked.trained.own = {gap::state_of(ground_.study, ground_.study.courses[0].record())};
            ranked.candidate = ranked.trained;
        }
    }

    static constexpr int samples = 400;
    gap::Question question_;  // whose records the ground looks at
    gap::Ground ground_;
    gap::Whitener whitener_;
    std::vector<gap::Ranked> ranking_;
    gap::FoundOut known_;
};

TEST_F(Rules, HaveNamesOfTheirOwnAndReasons) {
    std::set<std::string> names;
    for (const gap::Rule& rule : gap::rules()) {
        EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
        EXPECT_THAT(rule.reason, HasSubstr(" ")) << rule.name;
        EXPECT_EQ(gap::rule_named(rule.name).apply, rule.apply);
    }
    EXPECT_THAT(names, SizeIs(13));
    EXPECT_THROW((void)gap::rule_named("luck"), std::out_of_range);
}

TEST_F(Rules, ClearAdvantageIsEightUnitsOfLikelihood) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 7.97);
    gap::Decision decision = after("clear_advantage");
    EXPECT_EQ(decision.outcome, Outcome::no_gap);
    EXPECT_NEAR(decision.confidence, 0.95 - 0.3 * 7.97 / 8.0, 1e-9);  // nearly named
    ranking_[drag].by_sample.assign(samples, 8.03 / samples);
    decision = after("clear_advantage");
    EXPECT_EQ(decision.outcome, Outcome::attributed);
    EXPECT_THAT(decision.effects, ElementsAre(drag));
    // In every block of samples, not in one.
    ranking_[drag].by_sample.assign(samples, 0.0);
    ranking_[drag].by_sample[7] = 8.1;
    EXPECT_EQ(after("clear_advantage").outcome, Outcome::no_gap);
}

TEST_F(Rules, ClearAdvantageTakesAMaterialShareOfTheGap) {
    const std::size_t drag = add({"quadratic_drag"}, 0.96985, 100.0);
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
    ranking_[drag].gap_after = 0.97015;
    EXPECT_THAT(after("clear_advantage").effects, IsEmpty());
    beside_a_form();
    ranking_[drag].gap_after = 0.751;
    EXPECT_THAT(after("clear_advantage").effects, IsEmpty());
    ranking_[drag].gap_after = 0.749;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
}

TEST_F(Rules, ClearAdvantageOfAFurtherEffectIsOverOneFewer) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 50.0);
    const std::size_t both = add({"quadratic_drag", "backlash"}, 0.4, 57.0);
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
    ranking_[both].by_sample.assign(samples, 59.0 / samples);
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[both].gap_after = 0.49;  // a twenty-fifth of what can be closed would be 0.02
    ranking_[both].log_likelihood = 59.0;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
    // It is 0.04 (1 - g), which 0.5 - g is where g = 0.46 / 0.96; or a quarter of what is left, where that is less.
    ranking_[both].gap_after = 0.46 / 0.96 - 1e-4;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[both].gap_after = 0.46 / 0.96 + 1e-4;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
    ranking_[drag].gap_after = 0.1;
    ranking_[both].gap_after = 0.0749;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[both].gap_after = 0.0751;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
}

TEST_F(Rules, ClearAdvantageOfFourEffectsIsTheMost) {
    std::vector<std::string> effects;
    std::vector<std::size_t> at;
    double gap_after = 1.0;
    for (const char* name : {"quadratic_drag", "backlash", "supply_sag", "input_curve", "output_curve"}) {
        effects.emplace_back(name);
        at.push_back(add(effects, gap_after -= 0.15, 50.0 * static_cast<double>(effects.size())));
    }
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(at[3]));
}

TEST_F(Rules, ClearAdvantageOfAFurtherEventBesideAFormTakesHalf) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 50.0);
    const std::size_t both = add({"quadratic_drag", "load_disturbance"}, 0.26, 100.0);
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    beside_a_form();
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
    ranking_[both].gap_after = 0.2495;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
}

TEST_F(Rules, ClearAdvantageIsNoneOfWhatTrainingLeavesOpen) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    known_.objections[drag] = "training leaves quadratic_drag.coefficient anywhere";
    EXPECT_EQ(after("clear_advantage").outcome, Outcome::no_gap);
}

TEST_F(Rules, ClearAdvantageOfWhatCannotBeNamedIsMoreThanNothing) {
    const std::size_t drag = add({"quadratic_drag"}, 0.49, 100.0);
    known_.objections[drag] = "training leaves it open";
    std::rotate(ranking_.begin(), ranking_.begin() + 1, ranking_.end());  // the best first
    std::swap(known_.objections[0], known_.objections[1]);
    EXPECT_EQ(after("clear_advantage").outcome, Outcome::no_gap);
    beside_a_form();
    const gap::Decision decision = after("clear_advantage");
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_EQ(decision.confidence, 0.7);
    EXPECT_THAT(decision.notes,
                ElementsAre("quadratic_drag would bring the gap to 0.4900, but training leaves it open"));
    ranking_[0].gap_after = 0.502;
    EXPECT_EQ(after("clear_advantage").outcome, Outcome::no_gap);
    // Of two thousandths of the variance it is no matter.
    ranking_[0].gap_after = 0.01;
    ranking_[1].gap_after = 0.0446;
    EXPECT_EQ(after("clear_advantage").outcome, Outcome::no_gap);
    ranking_[1].gap_after = 0.0449;
    EXPECT_EQ(after("clear_advantage").outcome, Outcome::unknown);
}

TEST_F(Rules, WhatCanBeForeseenIsNoNoise) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    gap::Decision decision = after("what_can_be_foreseen", attributed(drag));
    EXPECT_EQ(decision.outcome, Outcome::attributed);
    known_.remainders[drag] = {0.4, false, {}};  // by chance
    EXPECT_EQ(after("what_can_be_foreseen", attributed(drag)).outcome, Outcome::attributed);
    known_.remainders[drag] = {0.4, true, {}};
    decision = after("what_can_be_foreseen", attributed(drag));
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("40 % can be foreseen")));
    EXPECT_NEAR(decision.noise_floor, 0.5 * std::sqrt(0.6), 1e-12);
    // Of the squared gap that can be closed this is 0.1 of 0.85: beside a fitted form the rest is its main cause's.
    EXPECT_NEAR(decision.confidence, 0.5 + 0.5 * 0.1 / 0.85, 1e-9);
    beside_a_form();
    EXPECT_EQ(after("what_can_be_foreseen", attributed(drag)).outcome, Outcome::attributed);
    ranking_[drag].gap_after = 0.8;
    EXPECT_EQ(after("what_can_be_foreseen", attributed(drag)).outcome, Outcome::unknown);
}

TEST_F(Rules, WhatCanBeForeseenOfAFittedFormIsItsOwnWhereItIsSmall) {
    beside_a_form();
    known_.remainders[0] = {0.5, true, {}};
    gap::Decision none;
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.0449;
    EXPECT_EQ(after("what_can_be_foreseen", none).outcome, Outcome::unknown);
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.0446;
    EXPECT_EQ(after("what_can_be_foreseen", none).outcome, Outcome::no_gap);
    // Or within 11 % of its rms: a share of the squares s leaves sqrt(1 - s) of it.
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.5;
    known_.remainders[0] = {1.0 - 0.8905 * 0.8905, true, {}};
    EXPECT_EQ(after("what_can_be_foreseen", none).outcome, Outcome::no_gap);
    known_.remainders[0] = {1.0 - 0.8895 * 0.8895, true, {}};
    EXPECT_EQ(after("what_can_be_foreseen", none).outcome, Outcome::unknown);
}

// An operating point that has moved since the base was fitted is foreseen by nothing that the input did.
TEST_F(Rules, WhatCanBeForeseenIsNoLevel) {
    beside_a_form();
    known_.remainders[0] = {0.5, true, {}};  // about the level
    gap::Decision none;
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.3;
    const double deviation = gap::output_deviation(ground_.validation);
    const auto share_at = [&](double level, double about) {
        std::vector<double>& left = ranking_[0].residuals[0];
        for (std::size_t i = 0; i < left.size(); ++i) {
            left[i] = deviation * (level + (i % 2 == 0 ? about : -about));
        }
        return gap::foreseeable(evidence(), none).share;
    };
    EXPECT_NEAR(share_at(0.0, 0.1), 0.5, 1e-3);
    EXPECT_NEAR(share_at(0.1, 0.1), 0.25, 1e-3);
    EXPECT_EQ(after("what_can_be_foreseen", none).outcome, Outcome::unknown);
    EXPECT_NEAR(share_at(0.24, 0.1), 0.5 * 0.01 / (0.01 + 0.0576), 1e-3);
    const gap::Decision moved = after("what_can_be_foreseen", none);
    EXPECT_EQ(moved.outcome, Outcome::no_gap);
    EXPECT_THAT(moved.notes, testing::Contains(HasSubstr("the operating point's")));
    // A quarter of the deviation is no weather; a given model has no operating point to move.
    EXPECT_NEAR(share_at(0.26, 0.1), 0.5, 1e-3);
    ground_.study.base.refit = false;
    EXPECT_NEAR(share_at(0.1, 0.1), 0.5, 1e-3);
}

// A tenth of what is left at least, a part of what can be closed, and two hundredths of the gap.
TEST_F(Rules, WhatCanBeForeseenIsMaterial) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    const auto share = [&](double explained) {
        known_.remainders[drag] = {explained, true, {}};
        return gap::foreseeable(evidence(), attributed(drag)).share;
    };
    EXPECT_EQ(share(0.0995), 0.0);
    EXPECT_EQ(share(0.1005), 0.1005);
    // s g^2 of 1 - (1 - s) g^2: a fortieth beside a model, 0.08 beside a form.
    const auto too_much = [&](double gap_after, double of_closable) {
        ranking_[drag].gap_after = gap_after;
        const double squared = gap_after * gap_after;
        (void)share(of_closable * (1.0 - squared) / (squared * (1.0 - of_closable)));
        const gap::Foreseeable rest = gap::foreseeable(evidence(), attributed(drag));
        EXPECT_NEAR(rest.of_closable, of_closable, 1e-12);
        return rest.is_too_much;
    };
    EXPECT_FALSE(too_much(0.4, 0.02495));
    EXPECT_TRUE(too_much(0.4, 0.02510));
    beside_a_form();
    EXPECT_FALSE(too_much(0.5, 0.0798));
    EXPECT_TRUE(too_much(0.5, 0.0804));
    EXPECT_TRUE((gap::Foreseeable{.of_closable = 0.1995}).is_minor());
    EXPECT_FALSE((gap::Foreseeable{.of_closable = 0.2005}).is_minor());
}

// Three effects that leave what can be foreseen are an expansion of something else: where it is two hundredths of the
// gap.
TEST_F(Rules, WhatCanBeForeseenBehindThreeEffectsIsTooMuch) {
    const std::size_t three = add({"quadratic_drag", "backlash", "supply_sag"}, 0.3, 100.0);
    const std::size_t two = add({"quadratic_drag", "backlash"}, 0.3, 90.0);
    const auto outcome = [&](std::size_t at, double taken) {
        const double left = 0.3 - taken;
        known_.remainders[at] = {1.0 - left * left / (0.3 * 0.3), true, {}};
        return after("what_can_be_foreseen", attributed(at)).outcome;
    };
    EXPECT_EQ(outcome(three, 0.0199), Outcome::attributed);
    EXPECT_EQ(outcome(three, 0.0201), Outcome::unknown);
    EXPECT_EQ(outcome(two, 0.0201), Outcome::attributed);
}

// The surer, the more of what can be closed it is: from a half up to 0.95.
TEST_F(Rules, WhatCanBeForeseenIsSureByItsShare) {
    const std::size_t three = add({"quadratic_drag", "backlash", "supply_sag"}, 0.05, 100.0);
    known_.remainders[three] = {0.75, true, {}};
    // 0.75 of 0.0025, of 1 - 0.25 of 0.0025.
    EXPECT_NEAR(after("what_can_be_foreseen", attributed(three)).confidence,
                0.5 + 0.5 * 0.75 * 0.0025 / (1.0 - 0.25 * 0.0025), 1e-9);
    known_.remainders[0] = {0.96, true, {}};
    gap::Decision none;
    none.base_gap = none.noise_floor = 1.0;
    const gap::Decision all = after("what_can_be_foreseen", none);
    EXPECT_EQ(all.outcome, Outcome::unknown);
    EXPECT_EQ(all.confidence, 0.95);
    EXPECT_NEAR(all.noise_floor, 0.2, 1e-12);
}

TEST_F(Rules, WhatCannotBePartedIsAnAlternative) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 50.0);
    const std::size_t friction = add({"coulomb_friction"}, 0.5, 44.03);
    const std::size_t backlash = add({"backlash"}, 0.5, 43.97);
    gap::Decision decision = after("what_cannot_be_parted", attributed(drag));
    EXPECT_EQ(decision.outcome, Outcome::ambiguous);
    EXPECT_THAT(decision.effects, ElementsAre(drag, friction));
    EXPECT_NEAR(decision.confidence, 0.45, 1e-12);
    ranking_[friction].by_sample.assign(samples, 43.97 / samples);
    decision = after("what_cannot_be_parted", attributed(drag));
    EXPECT_THAT(decision.effects, ElementsAre(drag));
    EXPECT_NEAR(decision.confidence, 0.5 + 0.47 * (1.0 - std::exp(-6.03 / 8.0)), 1e-9);
    // Not what training leaves open.
    ranking_[backlash].by_sample.assign(samples, 50.0 / samples);
    known_.objections[backlash] = "open";
    EXPECT_THAT(after("what_cannot_be_parted", attributed(drag)).effects, ElementsAre(drag));
}

TEST_F(Rules, WhatCannotBePartedIsNamedByTheSimplerOne) {
    const std::size_t lag = add({"direction_asymmetry"}, 0.5, 50.0);
    const std::size_t sensor = add({"sensor_lag"}, 0.5, 49.0);
    const gap::Decision decision = after("what_cannot_be_parted", attributed(lag));
    EXPECT_EQ(decision.outcome, Outcome::attributed);
    EXPECT_THAT(decision.effects, ElementsAre(sensor));
    EXPECT_EQ(decision.chosen, sensor);
    // The wider one is none of the simpler one's rivals.
    EXPECT_THAT(after("what_cannot_be_parted", attributed(sensor)).effects, ElementsAre(sensor));
}

TEST_F(Rules, WhatCannotBePartedBesideAFormIsWhatGoesAsFar) {
    const std::size_t cubic = add({"cubic_stiffness"}, 0.30, 900.0);
    const std::size_t curve = add({"input_curve"}, 0.35, 500.0);
    add({"supply_sag"}, 0.37, 500.0);
    const auto named = [&] { return after("what_cannot_be_parted", attributed(cubic)).effects; };
    set_noise(0.30 / 7.03);
    EXPECT_THAT(named(), ElementsAre(cubic));
    beside_a_form();
    EXPECT_THAT(named(), ElementsAre(cubic, curve));
    set_noise(0.30 / 6.97);  // a sensor's noise tells likelihoods
    EXPECT_THAT(named(), ElementsAre(cubic));
    // Within a fifth more, and on this side of half the way back.
    set_noise(0.30 / 7.03);
    ranking_[curve].gap_after = 0.359;
    EXPECT_THAT(named(), ElementsAre(cubic, curve));
    ranking_[curve].gap_after = 0.361;
    EXPECT_THAT(named(), ElementsAre(cubic));
    ranking_[0].gap_after = 0.40;
    ranking_[curve].gap_after = 0.349;
    EXPECT_THAT(named(), ElementsAre(cubic, curve));
    ranking_[curve].gap_after = 0.3504;
    EXPECT_THAT(named(), ElementsAre(cubic));
}

// Where some blocks of samples say the opposite twice as much is asked.
TEST_F(Rules, WhatCannotBePartedInEveryBlockIsTwiceAsMuch) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 50.0);
    const std::size_t backlash = add({"backlash"}, 0.5, 50.0);
    const auto behind = [&](double by) {
        ranking_[backlash].by_sample.assign(samples, 50.0 / samples);
        ranking_[backlash].by_sample[7] -= by + 2.0;
        ranking_[backlash].by_sample[300] += 2.0;
        ranking_[backlash].log_likelihood = 50.0 - by;
        return after("what_cannot_be_parted", attributed(drag)).effects;
    };
    EXPECT_THAT(behind(11.9), ElementsAre(drag, backlash));
    EXPECT_THAT(behind(12.06), ElementsAre(drag));
}

TEST_F(Rules, WhatCannotBePartedBesideAFormIsNoEventBesideWhatLasts) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 50.0);
    add({"load_disturbance"}, 0.5, 49.0);
    EXPECT_EQ(after("what_cannot_be_parted", attributed(drag)).outcome, Outcome::ambiguous);
    beside_a_form();
    const gap::Decision decision = after("what_cannot_be_parted", attributed(drag));
    EXPECT_THAT(decision.effects, ElementsAre(drag));
    EXPECT_NEAR(decision.confidence, 0.5 + 0.47 * (1.0 - std::exp(-6.0 / 8.0)), 1e-9);
}

TEST_F(Rules, FittedFormsLeaveDoubt) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    const std::size_t jump = add({"missed_counts"}, 0.5, 100.0);
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.97);
    beside_a_form();
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.97);
    EXPECT_EQ(after("fitted_forms", attributed(jump)).confidence, 0.8);
    // The more so the more is left that is no noise.
    set_noise(0.01);
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.7);
    ranking_[drag].gap_after = 0.2515;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.7);
    ranking_[drag].gap_after = 0.249;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.9);
    ranking_[drag].gap_after = 0.1005;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.9);
    ranking_[drag].gap_after = 0.0995;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.95);
    set_noise(1.0);
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.97);
    ranking_[drag].gap_after = 0.5;
    known_.remainders[drag] = {0.4, true, {}};  // or can be foreseen
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.7);
}

TEST_F(Rules, RoundedReadingsAreNamedWhereTheyAreMostOfWhatIsLeft) {
    const std::size_t step = add({"encoder_quantisation"}, 0.01, 0.0);
    gap::Decision none;
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.1;
    const double half = std::sqrt(0.5 * 12.0) * 0.1 * gap::output_deviation(ground_.validation);
    ground_.study.scales.quantum = 0.998 * half;
    EXPECT_EQ(after("rounded_readings", none).outcome, Outcome::no_gap);
    ground_.study.scales.quantum = 1.002 * half;
    const gap::Decision decision = after("rounded_readings", none);
    EXPECT_EQ(decision.outcome, Outcome::attributed);
    EXPECT_THAT(decision.effects, ElementsAre(step));
    EXPECT_EQ(decision.noise_floor, 0.01);
    EXPECT_EQ(decision.confidence, 0.9);
}

TEST_F(Rules, WhatIsNoNoiseIsNotNothing) {
    gap::Decision none;
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.1;
    set_noise(0.1 / 6.97);
    EXPECT_EQ(after("what_is_no_noise", none).outcome, Outcome::no_gap);
    set_noise(0.1 / 7.03);
    const gap::Decision decision = after("what_is_no_noise", none);
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("no noise of a sensor")));
    // Of a small gap twice as much is tolerated; of a fitted form's all.
    none.base_gap = ranking_[0].gap_after = 0.04;
    set_noise(0.04 / 14.93);
    EXPECT_EQ(after("what_is_no_noise", none).outcome, Outcome::no_gap);
    set_noise(0.04 / 15.07);
    EXPECT_EQ(after("what_is_no_noise", none).outcome, Outcome::unknown);
    none.base_gap = ranking_[0].gap_after = 0.0502;
    set_noise(0.0502 / 7.1);
    EXPECT_EQ(after("what_is_no_noise", none).outcome, Outcome::unknown);
    none.base_gap = ranking_[0].gap_after = 0.0499;
    EXPECT_EQ(after("what_is_no_noise", none).outcome, Outcome::no_gap);
    beside_a_form();
    set_noise(1e-3);
    none.base_gap = ranking_[0].gap_after = 0.0446;
    EXPECT_EQ(after("what_is_no_noise", none).outcome, Outcome::no_gap);
    none.base_gap = ranking_[0].gap_after = 0.0449;
    EXPECT_EQ(after("what_is_no_noise", none).outcome, Outcome::unknown);
}

TEST_F(Rules, WhatIsNoNoiseBesideACauseIsAnotherCause) {
    const std::size_t jump = add({"missed_counts"}, 0.1005, 100.0);
    set_noise(0.01);
    EXPECT_EQ(after("what_is_no_noise", attributed(jump)).outcome, Outcome::unknown);
    ranking_[jump].gap_after = 0.0995;  // a tenth of the gap of a given model
    EXPECT_EQ(after("what_is_no_noise", attributed(jump)).outcome, Outcome::attributed);
    beside_a_form();
    // A fifth of the squared gap of a fitted form.
    ranking_[jump].gap_after = 0.445;
    EXPECT_EQ(after("what_is_no_noise", attributed(jump)).outcome, Outcome::attributed);
    ranking_[jump].gap_after = 0.449;
    EXPECT_EQ(after("what_is_no_noise", attributed(jump)).outcome, Outcome::unknown);
}

// Slow, and of no input: beside a fitted base that is what disturbs the plant.
TEST_F(Rules, WhatIsNoNoiseMayDisturbThePlant) {
    std::mt19937_64 engine(5);
    std::normal_distribution<double> normal;
    for (auto* records : {&question_.train, &question_.validate}) {
        for (gap::Record& record : *records) {
            double state = 0.0;
            for (double& z : record.output) {
                state = 0.9 * state + 0.02 * normal(engine);
                z += state;
            }
        }
    }
    ground_ = gap::prepare(question_);
    beside_a_form();
    const std::vector<std::vector<double>> left = gap::all_residuals(ground_.validation, ranking_[0].candidate);
    ranking_[0].residuals = left;
    gap::Decision none;
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.1;
    none.confidence = 0.95;
    set_noise(0.01);
    const auto outcome = [&] { return after("what_is_no_noise", none).outcome; };
    const gap::Decision decision = after("what_is_no_noise", none);
    EXPECT_EQ(decision.outcome, Outcome::no_gap);
    EXPECT_TRUE(decision.disturbed);
    EXPECT_EQ(decision.confidence, 0.7);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("a disturbance of the plant")));
    // What input and output foresee for certain, or a third of, is none.
    known_.remainders[0] = {0.32, false, {}};
    EXPECT_EQ(outcome(), Outcome::no_gap);
    known_.remainders[0] = {0.34, false, {}};
    EXPECT_EQ(outcome(), Outcome::unknown);
    known_.remainders[0] = {0.05, true, {}};
    EXPECT_EQ(outcome(), Outcome::unknown);
    known_.remainders[0] = {};
    // A quarter of what the output does is no noise, unless the plant integrates what disturbs it, or in a loop.
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.249;
    EXPECT_EQ(outcome(), Outcome::no_gap);
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.251;
    EXPECT_EQ(outcome(), Outcome::unknown);
    ground_.study.scales.steady = false;
    EXPECT_EQ(outcome(), Outcome::no_gap);
    ground_.study.scales.steady = true;
    ground_.study.horizon = 5;
    EXPECT_EQ(outcome(), Outcome::no_gap);
    ground_.study.horizon = 0;
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.1;
    // Something listed takes 15 % of it.
    none.noise_floor = 0.0852;
    EXPECT_EQ(outcome(), Outcome::no_gap);
    none.noise_floor = 0.0848;
    EXPECT_EQ(outcome(), Outcome::unknown);
    none.noise_floor = 0.1;
    // Twice as large as where it was fitted; or nobody drives it; or the model is given.
    for (double& one : ranking_[0].residuals[0]) {
        one *= 2.0;
    }
    EXPECT_EQ(outcome(), Outcome::unknown);
    ranking_[0].residuals = left;
    ground_.study.scales.driven = false;
    EXPECT_EQ(outcome(), Outcome::unknown);
    ground_.study.scales.driven = true;
    EXPECT_EQ(outcome(), Outcome::no_gap);
    ground_.study.base.refit = false;
    EXPECT_EQ(outcome(), Outcome::unknown);
}

TEST_F(Rules, PatternsAreNoNoise) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    std::vector<double>& left = ranking_[drag].residuals[0];
    for (std::size_t i = 0; i < left.size(); ++i) {
        left[i] = 0.003 * std::sin(static_cast<double>(i * i));  // as good as noise
    }
    EXPECT_EQ(after("patterns", attributed(drag)).outcome, Outcome::attributed);
    for (std::size_t i = left.size() / 2; i < left.size() / 2 + 100; ++i) {
        left[i] *= 30.0;
    }
    const gap::Decision decision = after("patterns", attributed(drag));
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("as loud from")));
    // Jitter is louder where the output moves; so is a fitted form's misfit.
    const std::size_t jitter = add({"sampling_jitter"}, 0.5, 100.0);
    ranking_[jitter].residuals = ranking_[drag].residuals;
    EXPECT_EQ(after("patterns", attributed(jitter)).outcome, Outcome::attributed);
    beside_a_form();
    EXPECT_EQ(after("patterns", attributed(drag)).outcome, Outcome::attributed);
}

// Fifty times the usual square, of what is left at least four hundredths of the gap.
TEST_F(Rules, PatternsOfABurstAreFiftyTimesAsLoud) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    const gap::Record& record = ground_.validation.courses[0].record();
    constexpr std::size_t stretch = 20;  // half a time constant
    ground_.validation.scales.time_constant_s = (2.0 * stretch + 0.5) * record.usual_interval_s;
    ground_.validation.scales.quantum = 0.0;
    const auto outcome = [&](double ratio) {
        std::vector<double>& left = ranking_[drag].residuals[0];
        for (std::size_t i = 0; i < left.size(); ++i) {
            left[i] = (i % 2 == 0 ? 0.003 : -0.003) * (i / stretch == 7 ? std::sqrt(ratio) : 1.0);
        }
        return after("patterns", attributed(drag)).outcome;
    };
    EXPECT_EQ(outcome(49.8), Outcome::attributed);
    EXPECT_EQ(outcome(50.2), Outcome::unknown);
    // What steps of the reading make is no usual stretch's due: 0.29 of a step.
    ground_.validation.scales.quantum = 0.003 * std::sqrt(60.0 / 50.2) / 0.29;
    EXPECT_EQ(outcome(60.0), Outcome::unknown);
    ground_.validation.scales.quantum = 0.003 * std::sqrt(60.0 / 49.8) / 0.29;
    EXPECT_EQ(outcome(60.0), Outcome::attributed);
    ground_.validation.scales.quantum = 0.0;
    ranking_[drag].gap_after = 0.0402;
    EXPECT_EQ(outcome(60.0), Outcome::unknown);
    ranking_[drag].gap_after = 0.0398;
    EXPECT_EQ(outcome(60.0), Outcome::attributed);
    ranking_[drag].gap_after = 0.5;
    ground_.study.scales.held_share = 0.01;
    EXPECT_EQ(outcome(60.0), Outcome::attributed);
}

TEST_F(Rules, PatternsAreWavesThatTheInputHasNot) {
    for (auto* records : {&question_.train, &question_.validate}) {
        for (gap::Record& record : *records) {
            for (std::size_t i = 0; i < record.size(); ++i) {
                record.output[i] += 0.02 * std::sin(2.0 * std::numbers::pi * 7.3 * record.time_s[i]);
            }
        }
    }
    ground_ = gap::prepare(question_);
    ranking_[0].residuals = gap::all_residuals(ground_.validation, ranking_[0].candidate);
    const gap::Decision decision = after("patterns");
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("a wave of 7.")));
    // What was let go swings by itself.
    ground_.study.scales.driven = false;
    EXPECT_EQ(after("patterns").outcome, Outcome::no_gap);
}

TEST_F(Rules, EventsFromOutsideDoNotLastThroughout) {
    const std::size_t load = add({"load_disturbance"}, 0.5, 100.0);
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 99.0);
    const double length_s = ground_.study.scales.length_s;
    auto more = gap::parameters_of(gap::effect_named("load_disturbance"), ground_.study.scales, 0);
    for (gap::FreeParameter& one : more) {
        one.value = one.name.ends_with("from_s") ? 0.0 : one.name.ends_with("to_s") ? length_s : 1.0;
    }
    auto& own = ranking_[load].trained.own[0];
    own.insert(own.end(), more.begin(), more.end());
    gap::Decision decision = after("events_from_outside", attributed(load));
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_LE(decision.confidence, 0.7);
    // What noise makes of a record that has no event is none.
    const auto of_validation = [&](double size) {
        auto& judged = ranking_[load].candidate.own[0];
        judged.erase(judged.end() - static_cast<std::ptrdiff_t>(more.size()), judged.end());
        for (gap::FreeParameter one : more) {
            one.value = one.name.ends_with("from_s") ? 0.41 * length_s
                        : one.name.ends_with("to_s") ? 0.6 * length_s
                                                     : size;
            judged.push_back(one);
        }
        return after("events_from_outside", attributed(load)).outcome;
    };
    ranking_[load].candidate.own[0].insert(ranking_[load].candidate.own[0].end(), more.begin(), more.end());
    EXPECT_EQ(of_validation(19.9), Outcome::unknown);
    EXPECT_EQ(of_validation(-20.1), Outcome::attributed);
    of_validation(1.0);
    gap::Decision both = attributed(load);
    both.effects = {load, drag};
    decision = after("events_from_outside", both);
    EXPECT_EQ(decision.outcome, Outcome::attributed);
    EXPECT_THAT(decision.effects, ElementsAre(drag));
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("an event from outside does not")));
}

// So that what lasts is asked in its place.
TEST_F(Rules, EventsThatAreNoneCannotBeTakenBesideAForm) {
    const std::size_t load = add({"load_disturbance"}, 0.5, 100.0);
    beside_a_form();
    known_.objections.erase(load);
    const double length_s = ground_.study.scales.length_s;
    const auto objection = [&](double from_s) {
        for (gap::Candidate* candidate : {&ranking_[load].trained, &ranking_[load].candidate}) {
            candidate->own = {gap::state_of(ground_.study, ground_.study.courses[0].record())};
            for (gap::FreeParameter one :
                 gap::parameters_of(gap::effect_named("load_disturbance"), ground_.study.scales, 0)) {
                one.value = one.name.ends_with("from_s") ? from_s : one.name.ends_with("to_s") ? length_s : 0.1;
                candidate->own[0].push_back(one);
            }
        }
        return evidence().objection(load);
    };
    EXPECT_THAT(objection(0.0), HasSubstr("still there at the end: an event from outside does not"));
    EXPECT_THAT(objection(0.63 * length_s), Not(HasSubstr("from outside does not")));
}

TEST_F(Rules, WhatCannotBeNamedOutdoesWhatIs) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    const std::size_t jump = add({"missed_counts"}, 0.249, 100.0);
    const std::size_t with_it = add({"quadratic_drag", "missed_counts"}, 0.1, 200.0);
    known_.objections[jump] = known_.objections[with_it] = "every record needs one of its own";
    const auto outcome = [&] { return after("what_is_outdone", attributed(drag)).outcome; };
    const auto lead = [&](double advantage) {
        ranking_[jump].by_sample.assign(samples, advantage / samples);
        ranking_[jump].log_likelihood = advantage;
    };
    beside_a_form();
    set_noise(0.01);
    lead(107.9);
    EXPECT_EQ(outcome(), Outcome::attributed);
    lead(108.1);
    const gap::Decision decision = after("what_is_outdone", attributed(drag));
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("missed_counts would bring the gap to 0.2490, without")));
    EXPECT_EQ(after("suspects", decision).suspect, drag);
    ranking_[jump].gap_after = 0.251;
    EXPECT_EQ(outcome(), Outcome::attributed);
    ranking_[jump].gap_after = 0.249;
    known_.objections[jump] = "";  // what can be named is an alternative, or was chosen
    EXPECT_EQ(outcome(), Outcome::attributed);
    known_.objections[jump] = "every record needs one of its own";
    set_noise(0.1);  // where noise is left it is no other cause
    EXPECT_EQ(outcome(), Outcome::attributed);
}

TEST_F(Rules, FewAlternativesAreNamed) {
    const std::vector<std::string> names = {"quadratic_drag", "backlash",   "supply_sag",
                                            "input_curve",    "gain_error", "output_curve"};
    gap::Decision all;
    all.outcome = Outcome::ambiguous;
    double gap_after = 0.50;
    for (const std::string& name : names) {
        all.effects.push_back(add({name}, gap_after -= 0.01, 100.0));
    }
    gap::Decision decision = after("few_alternatives", all);  // a given model: what equals a gain is the gain's
    EXPECT_THAT(decision.effects, ElementsAre(1, 2, 5));
    EXPECT_NEAR(decision.confidence, 0.3, 1e-12);
    beside_a_form();
    decision = after("few_alternatives", all);
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("6 causes explain these records equally well: quadratic_drag")));
    all.effects.pop_back();
    decision = after("few_alternatives", all);  // those that go farthest
    EXPECT_THAT(decision.effects, ElementsAre(5, 4, 3));
    EXPECT_EQ(decision.chosen, 5u);
    EXPECT_THAT(decision.notes, SizeIs(1));
    all.effects.resize(3);
    EXPECT_THAT(after("few_alternatives", all).notes, IsEmpty());
}

TEST_F(Rules, LogsOfAnotherDriveAreExplainedByNothing) {
    const std::size_t drag = add({"quadratic_drag"}, 0.502, 100.0);
    const gap::Decision decision = after("logs_of_another_drive", attributed(drag, 0.602));
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_EQ(decision.confidence, 0.3);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("do model and log belong together?")));
    EXPECT_EQ(after("logs_of_another_drive", attributed(drag, 0.598)).outcome, Outcome::attributed);
    ranking_[drag].gap_after = 0.498;
    EXPECT_EQ(after("logs_of_another_drive", attributed(drag, 0.602)).outcome, Outcome::attributed);
}

TEST_F(Rules, InputsThatNeverMoveTellOneStep) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    EXPECT_EQ(after("inputs_that_never_move", attributed(drag)).confidence, 0.97);
    gap::Question question = gap_test::question_of({}, {.seed = 33}, {.seed = 34});
    for (double& u : question.train[0].input) {
        u = 0.1;
    }
    ground_ = gap::prepare(question);
    const gap::Decision decision = after("inputs_that_never_move", attributed(drag));
    EXPECT_EQ(decision.confidence, 0.5);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("the input never moves")));
}

TEST_F(Rules, SuspectsAreWhatLeadsAnUnknown) {
    add({"quadratic_drag"}, 0.952, 100.0);
    const std::size_t open = add({"backlash"}, 0.5, 100.0);
    const std::size_t sag = add({"supply_sag"}, 0.949, 100.0);
    known_.objections[open] = "open";
    gap::Decision unknown;
    unknown.outcome = Outcome::unknown;
    EXPECT_EQ(after("suspects", unknown).suspect, sag);
    unknown.chosen = open;  // what was chosen and then doubted
    EXPECT_EQ(after("suspects", unknown).suspect, open);
    EXPECT_FALSE(after("suspects", attributed(sag)).suspect);
}

}  // namespace
