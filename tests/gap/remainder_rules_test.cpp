// Rules of the decision at their thresholds: what is left, and whether that can be noise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "rules_case.hpp"

namespace {

using gap::Outcome;
using gap_test::Rules;
using testing::ElementsAre;
using testing::HasSubstr;

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
    // Worth a line is half of the gap: its square is then a third of the square about it.
    const auto said = [&](double level) {
        (void)share_at(level, 0.1);
        const gap::Decision decision = after("what_can_be_foreseen", none);
        return std::ranges::any_of(decision.notes,
                                   [](const std::string& note) { return note.find("the level has moved") == 0; });
    };
    EXPECT_FALSE(said(0.0997 * std::tan(std::numbers::pi / 6.0)));
    EXPECT_TRUE(said(0.1003 * std::tan(std::numbers::pi / 6.0)));
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
    // Just that much is tolerated: 0.75 of 9.375.
    ranking_[drag].gap_after = 1.0;
    known_.remainders[drag] = {0.75, true, {}};
    gap::Decision at_the_edge = attributed(drag, 3.0625);
    at_the_edge.noise_floor = 0.0625;
    const gap::Foreseeable edge = gap::foreseeable(evidence(), at_the_edge);
    EXPECT_EQ(edge.of_closable, 0.08);
    EXPECT_FALSE(edge.is_too_much);
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

// So are two beside a fitted form that leave a quarter, half of whose squares can be foreseen.
TEST_F(Rules, WhatCanBeForeseenBehindTwoEffectsIsHalfOfAQuarter) {
    const std::size_t two = add({"quadratic_drag", "backlash"}, 0.2505, 100.0);
    const std::size_t one = add({"quadratic_drag"}, 0.2505, 90.0);
    const auto outcome = [&](std::size_t at, double share) {
        known_.remainders[at] = {share, true, {}};
        return after("what_can_be_foreseen", attributed(at)).outcome;
    };
    EXPECT_EQ(outcome(two, 0.501), Outcome::unknown);  // of a model: a fortieth is too much
    beside_a_form();
    EXPECT_EQ(outcome(two, 0.501), Outcome::unknown);
    EXPECT_EQ(outcome(two, 0.499), Outcome::attributed);
    EXPECT_EQ(outcome(one, 0.501), Outcome::attributed);
    ranking_[two].gap_after = 0.2495;
    EXPECT_EQ(outcome(two, 0.501), Outcome::attributed);
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
}

// A form may leave two thousandths of the variance where noise hides what it is, and less where clean readings show it.
TEST_F(Rules, WhatIsNoNoiseOfAFittedFormIsItsOwnWhereItIsSmall) {
    beside_a_form();
    const auto small = [&](double gap, double noise) {
        set_noise(noise);
        return evidence().is_small_of_a_form(gap);
    };
    EXPECT_TRUE(small(0.0446, 0.0446 / 3.97));
    EXPECT_FALSE(small(0.0449, 0.0449 / 3.97));
    EXPECT_FALSE(small(0.0446, 0.0446 / 4.03));
    EXPECT_TRUE(small(0.0124, 1e-5));
    EXPECT_FALSE(small(0.0126, 1e-5));
    gap::Decision none;
    none.base_gap = none.noise_floor = ranking_[0].gap_after = 0.0126;
    EXPECT_EQ(after("what_is_no_noise", none).outcome, Outcome::unknown);
    none.base_gap = ranking_[0].gap_after = 0.0124;
    EXPECT_EQ(after("what_is_no_noise", none).outcome, Outcome::no_gap);
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
    // Two fifths of what was let go, whose phase gathers what a period is off by.
    ground_.study.scales.driven = false;
    ranking_[jump].gap_after = 0.631;
    EXPECT_EQ(after("what_is_no_noise", attributed(jump)).outcome, Outcome::attributed);
    ranking_[jump].gap_after = 0.634;
    EXPECT_EQ(after("what_is_no_noise", attributed(jump)).outcome, Outcome::unknown);
}

// A lasting cause may miss where training hardly tells its size, up to half of the gap.
TEST_F(Rules, WhatLeavesHalfOfTheGapIsNotItsCause) {
    const std::size_t drag = add({"quadratic_drag"}, 0.499, 100.0);
    set_noise(0.01);
    ground_.study.noise = 10.0;  // training is all noise
    beside_a_form();
    EXPECT_EQ(after("what_is_no_noise", attributed(drag)).outcome, Outcome::attributed);
    ranking_[drag].gap_after = 0.501;
    EXPECT_EQ(after("what_is_no_noise", attributed(drag)).outcome, Outcome::unknown);
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

}  // namespace
