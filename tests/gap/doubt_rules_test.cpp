// Rules of the decision at their thresholds: what speaks against an answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "gap/drive/fit.hpp"
#include "rules_case.hpp"

namespace {

using gap::Outcome;
using gap_test::Rules;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST_F(Rules, FittedFormsLeaveDoubt) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    const std::size_t jump = add({"missed_counts"}, 0.5, 100.0);
    for (const std::size_t one : {drag, jump}) {  // beside a model that is given they leave none
        EXPECT_EQ(after("fitted_forms", attributed(one)).confidence, 0.97);
    }
    beside_a_form();
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.97);
    EXPECT_EQ(after("fitted_forms", attributed(jump)).confidence, 0.8);
    // An event is located where it is judged; one that leaves a twentieth was at that time.
    ranking_[jump].gap_after = 0.0505;
    EXPECT_EQ(after("fitted_forms", attributed(jump)).confidence, 0.8);
    ranking_[jump].gap_after = 0.0495;
    EXPECT_EQ(after("fitted_forms", attributed(jump)).confidence, 0.97);
    // The more so the more is left that is no noise.
    set_noise(0.01);
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.7);
    ranking_[drag].gap_after = 0.2515;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.7);
    ranking_[drag].gap_after = 0.249;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.8);
    ranking_[drag].gap_after = 0.1005;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.8);
    ranking_[drag].gap_after = 0.0995;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.95);
    // Four times what differs from sample to sample is more than most sensors' noise.
    set_noise(0.0995 / 4.03);
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.95);
    set_noise(0.0995 / 3.97);
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.97);
    set_noise(1.0);
    ranking_[drag].gap_after = 0.5;
    known_.remainders[drag] = {0.4, true, {}};  // or can be foreseen
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.7);
    ranking_[drag].gap_after = 0.26;  // or half of it, however little of all: here 3 to 4 %
    known_.remainders[drag] = {0.52, true, {}};
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.7);
    known_.remainders[drag] = {0.48, true, {}};
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.97);
    known_.remainders[drag] = {0.52, true, {}};
    ranking_[drag].gap_after = 0.0505;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.8);
    ranking_[drag].gap_after = 0.0495;
    EXPECT_EQ(after("fitted_forms", attributed(drag)).confidence, 0.95);
}

// What is as likely and leaves clearly less may hold a second cause.
TEST_F(Rules, FittedFormsLeaveDoubtWhereMoreIsLeftThanNeedBe) {
    const std::size_t drag = add({"quadratic_drag"}, 0.06, 100.0);
    const auto confidence = [&](double floor) {
        gap::Decision decision = attributed(drag);
        decision.noise_floor = floor;
        return after("fitted_forms", std::move(decision)).confidence;
    };
    EXPECT_EQ(confidence(0.01), 0.97);
    beside_a_form();
    EXPECT_EQ(confidence(0.06 / 1.49), 0.97);
    EXPECT_EQ(confidence(0.06 / 1.51), 0.85);
    ranking_[drag].gap_after = 0.0405;
    EXPECT_EQ(confidence(0.01), 0.85);
    ranking_[drag].gap_after = 0.0395;  // of a base of 1
    EXPECT_EQ(confidence(0.01), 0.97);
}

// A disturbance in training and in validation: what a form's misfit looks like, unless nothing else is left.
class ADisturbance : public Rules {
protected:
    explicit ADisturbance(double in_training = 0.4)
        : asked_(with_disturbances(in_training)), disturbed_(gap::prepare(asked_)) {}
    gap::Question with_disturbances(double in_training) const {
        gap::Question question = question_;
        question.refit = true;
        const auto push = [](gap::Record& record, double from_s, double size) {
            for (std::size_t i = 0; i < record.size(); ++i) {
                const double since_s = record.time_s[i] - from_s;
                record.output[i] += since_s > 0.0 ? size * std::exp(-0.5 * since_s) * since_s : 0.0;
            }
        };
        push(question.train[0], 11.3, in_training);
        push(question.validate[0], 17.9, 0.4);
        return question;
    }
    std::string objection_where(double left, double noise) {
        disturbed_.validation.noise = noise * gap::output_deviation(disturbed_.validation);
        disturbed_.validation.least_deviation = 1e-9;
        gap::Ranked with = ranking_[0];
        with.trained = gap::fit(disturbed_.study, {&gap::effect_named("load_disturbance")}, disturbed_.base, nullptr);
        with.candidate = gap::carried_over(disturbed_.validation, with.trained, nullptr);
        with.gap_after = left;
        const std::vector<gap::Ranked> ranking = {ranking_[0], with};
        return gap::Evidence(ranking, whitener_, disturbed_.study, disturbed_.validation, false).objection(1);
    }
    gap::Question asked_;  // whose records the ground looks at
    gap::Ground disturbed_;
};

TEST_F(ADisturbance, ThatEveryRecordNeedsIsNoneUnlessItExplainsAll) {
    EXPECT_THAT(objection_where(0.051, 1.0), HasSubstr("every record needs"));
    EXPECT_EQ(objection_where(0.049, 1.0), "");
    EXPECT_THAT(objection_where(0.049, 0.049 / 7.03), HasSubstr("every record needs"));
    EXPECT_EQ(objection_where(0.049, 0.049 / 6.97), "");
}

class ASmallDisturbance : public ADisturbance {
protected:
    ASmallDisturbance() : ADisturbance(0.01) {}
};

// As clear as it is: below a twentieth of the largest it follows what the form leaves.
TEST_F(ASmallDisturbance, IsNotNeeded) { EXPECT_EQ(objection_where(0.051, 1.0), ""); }

// An interval is a straight line's: what training is missed by without an effect tells more.
TEST_F(Rules, WhatTrainingNeedsIsToldWhateverItsInterval) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 100.0);
    beside_a_form();
    known_.objections.erase(drag);
    ranking_[drag].trained.cost = 1.0;
    ranking_[0].trained.cost = 3.99;
    EXPECT_FALSE(evidence().training_needs(drag, gap::effect_named("quadratic_drag")));
    EXPECT_THAT(evidence().objection(drag), HasSubstr("training leaves quadratic_drag"));
    ranking_[0].trained.cost = 4.01;
    EXPECT_TRUE(evidence().training_needs(drag, gap::effect_named("quadratic_drag")));
    EXPECT_EQ(evidence().objection(drag), "");
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
    EXPECT_EQ(decision.chosen, drag);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("an event from outside does not")));
}

TEST_F(Rules, EventsFromOutsideLeaveASixthBesideAForm) {
    const std::size_t load = add({"load_disturbance"}, 0.5, 100.0);
    const std::size_t both = add({"quadratic_drag", "coulomb_friction"}, 0.5, 99.0);
    const auto outcome = [&] { return after("events_from_outside", attributed(load)).outcome; };
    EXPECT_EQ(outcome(), Outcome::attributed);
    beside_a_form();
    gap::Decision decision = after("events_from_outside", attributed(load));
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("load_disturbance leaves 50 % of the gap")));
    decision = attributed(load);
    decision.effects = {load, both};
    decision = after("events_from_outside", decision);
    EXPECT_EQ(decision.outcome, Outcome::attributed);
    EXPECT_THAT(decision.effects, ElementsAre(both));
    ranking_[load].gap_after = 0.171;
    EXPECT_EQ(outcome(), Outcome::unknown);
    ranking_[load].gap_after = 0.169;
    EXPECT_EQ(outcome(), Outcome::attributed);
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
    const std::size_t jump = add({"missed_counts"}, 0.332, 100.0);
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
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("missed_counts would bring the gap to 0.3320, without")));
    EXPECT_EQ(after("suspects", decision).suspect, drag);
    ranking_[jump].gap_after = 0.335;
    EXPECT_EQ(outcome(), Outcome::attributed);
    ranking_[jump].gap_after = 0.332;
    known_.objections[jump] = "";  // what can be named is an alternative, or was chosen
    EXPECT_EQ(outcome(), Outcome::attributed);
    known_.objections[jump] = "every record needs one of its own";
    set_noise(0.1);  // where noise is left it is no other cause
    EXPECT_EQ(outcome(), Outcome::attributed);
    known_.remainders[drag] = {0.49, true, {}};  // but half of that is none that can be foreseen
    EXPECT_EQ(outcome(), Outcome::attributed);
    known_.remainders[drag] = {0.51, true, {}};
    EXPECT_EQ(outcome(), Outcome::unknown);
}

// What has a wider law in its stead says no other cause.
TEST_F(Rules, WhatHasAWiderLawOutdoesNothing) {
    const std::size_t friction = add({"coulomb_friction"}, 0.5, 100.0);
    const std::size_t wider = add({"direction_dependent_friction", "missed_counts"}, 0.2, 200.0);
    known_.objections[wider] = "every record needs one of its own";
    beside_a_form();
    set_noise(0.01);
    EXPECT_EQ(after("what_is_outdone", attributed(friction)).outcome, Outcome::attributed);
    ranking_[wider].trained.effects[0] = &gap::effect_named("quadratic_drag");
    EXPECT_EQ(after("what_is_outdone", attributed(friction)).outcome, Outcome::unknown);
}

// Two first terms of series that leave what is no noise follow a third thing, a spring's hysteresis, say.
TEST_F(Rules, TwoSmoothLawsThatLeaveMuchAreNoCauses) {
    const std::size_t chosen = add({"cubic_stiffness", "quadratic_drag"}, 0.151, 100.0);
    const std::size_t with_more = add({"cubic_stiffness", "quadratic_drag", "rate_limit"}, 0.12, 108.1);
    known_.objections[with_more] = "training leaves it open";
    beside_a_form();
    const auto outcome = [&] { return after("smooth_laws", attributed(chosen)).outcome; };
    const gap::Decision refused = after("smooth_laws", attributed(chosen));
    EXPECT_EQ(refused.outcome, Outcome::unknown);
    EXPECT_THAT(refused.notes, ElementsAre(HasSubstr("cubic_stiffness + quadratic_drag leaves 15 % of the gap")));
    EXPECT_EQ(after("suspects", refused).suspect, chosen);
    ranking_[with_more].gap_after = 0.1215;  // less than a fifth of what is left
    EXPECT_EQ(outcome(), Outcome::attributed);
    ranking_[with_more].gap_after = 0.12;
    ranking_[with_more].by_sample.assign(samples, 107.9 / samples);  // not clearly more likely
    EXPECT_EQ(outcome(), Outcome::attributed);
    known_.remainders[chosen] = {0.34, true, {}};
    EXPECT_EQ(outcome(), Outcome::unknown);
    known_.remainders[chosen] = {0.32, true, {}};
    EXPECT_EQ(outcome(), Outcome::attributed);
    known_.remainders[chosen] = {0.6, true, {}};
    ranking_[chosen].gap_after = 0.149;  // little is left
    EXPECT_EQ(outcome(), Outcome::attributed);
    ranking_[chosen].gap_after = 0.151;
    ranking_[chosen].trained.effects[1] = &gap::effect_named("coulomb_friction");  // which has a corner
    EXPECT_EQ(outcome(), Outcome::attributed);
    ranking_[chosen].trained.effects[1] = &gap::effect_named("output_curve");
    EXPECT_EQ(outcome(), Outcome::unknown);
    ranking_[chosen].trained.effects.pop_back();  // one of them is a cause
    EXPECT_EQ(outcome(), Outcome::attributed);
}

TEST_F(Rules, TwoSmoothLawsBesideAGivenModelAreItsCauses) {
    const std::size_t chosen = add({"cubic_stiffness", "quadratic_drag"}, 0.3, 100.0);
    known_.remainders[chosen] = {0.6, true, {}};
    EXPECT_EQ(after("smooth_laws", attributed(chosen)).outcome, Outcome::attributed);
}

// A lag that another base has helps whatever it stands beside.
TEST_F(Rules, WhatGoesFartherByALagAloneOutdoesNothing) {
    const std::size_t bend = add({"input_curve"}, 0.5, 100.0);
    const std::size_t other = add({"output_curve", "direction_asymmetry"}, 0.2, 200.0);
    const std::size_t helped = add({"direction_asymmetry", "input_curve"}, 0.1, 199.9);
    known_.objections[other] = known_.objections[helped] = "its lags up and down may be the same";
    const auto outcome = [&] { return after("what_is_outdone", attributed(bend)).outcome; };
    beside_a_form();
    set_noise(0.01);
    EXPECT_EQ(outcome(), Outcome::unknown);
    ranking_[helped].log_likelihood = 200.1;
    EXPECT_EQ(outcome(), Outcome::attributed);
    // What is no lag is another cause.
    ranking_[other].trained.effects[1] = &gap::effect_named("missed_counts");
    EXPECT_EQ(outcome(), Outcome::unknown);
}

TEST_F(Rules, LogsOfAnotherDriveAreExplainedByNothing) {
    const std::size_t drag = add({"quadratic_drag"}, 0.502, 100.0);
    const gap::Decision decision = after("logs_of_another_drive", attributed(drag, 0.602));
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_EQ(decision.confidence, 0.3);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("do model and log belong together?")));
    for (const double no_larger : {0.6, 0.598}) {
        EXPECT_EQ(after("logs_of_another_drive", attributed(drag, no_larger)).outcome, Outcome::attributed);
    }
    for (const double half_or_less : {0.5, 0.498}) {
        ranking_[drag].gap_after = half_or_less;
        EXPECT_EQ(after("logs_of_another_drive", attributed(drag, 0.602)).outcome, Outcome::attributed);
    }
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
