// Rules of the decision at their thresholds: which other candidates these data do not part from the one that is taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rules_case.hpp"

namespace {

using gap::Outcome;
using gap_test::Rules;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

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

// A valve that sticks and never jumps is a play, of as many numbers.
TEST_F(Rules, WhatCannotBePartedIsWhatItsNumbersSay) {
    const std::size_t valve = add({"valve_stiction"}, 0.5, 50.0);
    const std::size_t play = add({"input_hysteresis"}, 0.5, 49.0);
    const auto sticks_with = [&](double band, double jump) {
        ranking_[valve].trained.lasting[0][0].value = band;
        ranking_[valve].trained.lasting[0][1].value = jump;
        return after("what_cannot_be_parted", attributed(valve)).effects;
    };
    EXPECT_THAT(sticks_with(0.4, 0.0), ElementsAre(play));
    EXPECT_THAT(sticks_with(0.4, 0.039), ElementsAre(play));
    EXPECT_THAT(sticks_with(0.4, 0.041), ElementsAre(valve, play));
    // What says less than the numbers is none of it.
    ranking_[play].by_sample.assign(samples, 20.0 / samples);
    ranking_[play].gap_after = 0.6;
    EXPECT_THAT(sticks_with(0.4, 0.0), ElementsAre(valve));
}

// A force in one direction alone is an operating point: where that is fitted, friction has one level or two.
TEST_F(Rules, WhatCannotBePartedIsAlsoTheWiderOneWhereTheBaseTakesItUp) {
    const std::size_t even = add({"coulomb_friction"}, 0.5, 50.0);
    const std::size_t uneven = add({"direction_dependent_friction"}, 0.5, 49.0);
    known_.open[uneven] = true;
    EXPECT_THAT(after("what_cannot_be_parted", attributed(even)).effects, ElementsAre(even));
    beside_a_form();
    const gap::Decision decision = after("what_cannot_be_parted", attributed(even));
    EXPECT_EQ(decision.outcome, Outcome::ambiguous);
    EXPECT_THAT(decision.effects, ElementsAre(even, uneven));
    // From the wider one the simpler one is found, and both are said.
    EXPECT_THAT(after("what_cannot_be_parted", attributed(uneven)).effects, ElementsAre(even, uneven));
    // Training that tells both levels of it says that they are one.
    known_.open[uneven] = false;
    EXPECT_THAT(after("what_cannot_be_parted", attributed(even)).effects, ElementsAre(even));
    known_.open[uneven] = true;
    ranking_[uneven].by_sample.assign(samples, 43.97 / samples);
    ranking_[uneven].gap_after = 0.53;
    EXPECT_THAT(after("what_cannot_be_parted", attributed(even)).effects, ElementsAre(even));
}

TEST_F(Rules, WhatCannotBePartedBesideAFormIsSimplerWhereItLeavesATenthMore) {
    const std::size_t uneven = add({"direction_dependent_friction"}, 0.1, 900.0);
    const std::size_t even = add({"coulomb_friction"}, 0.1095, 500.0);
    EXPECT_THAT(after("what_cannot_be_parted", attributed(uneven)).effects, ElementsAre(uneven));
    beside_a_form();
    EXPECT_THAT(after("what_cannot_be_parted", attributed(uneven)).effects, ElementsAre(even));
    ranking_[even].gap_after = 0.1105;
    EXPECT_THAT(after("what_cannot_be_parted", attributed(uneven)).effects, ElementsAre(uneven));
    ranking_[even].gap_after = 0.1095;
    known_.objections[even] = "open";
    EXPECT_THAT(after("what_cannot_be_parted", attributed(uneven)).effects, ElementsAre(uneven));
}

// A load that is none beside friction is none beside friction of two levels.
TEST_F(Rules, WhatCannotBePartedFromWhatHoldsNoEventHoldsNone) {
    const std::size_t uneven = add({"direction_dependent_friction", "load_disturbance"}, 0.1, 900.0);
    const std::size_t even = add({"coulomb_friction", "load_disturbance"}, 0.109, 500.0);
    known_.objections[even] = "validation does not tell load_disturbance from none";
    EXPECT_THAT(after("what_cannot_be_parted", attributed(uneven)).effects, ElementsAre(uneven));
    beside_a_form();
    gap::Decision decision = after("what_cannot_be_parted", attributed(uneven));
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_THAT(decision.effects, IsEmpty());
    EXPECT_EQ(decision.chosen, even);
    EXPECT_EQ(decision.confidence, 0.7);
    ASSERT_EQ(decision.notes.size(), 1U);
    EXPECT_EQ(
        decision.notes[0],
        "coulomb_friction + load_disturbance says as much as direction_dependent_friction + load_disturbance, but "
        "validation does not tell load_disturbance from none");
    // Not what goes less far, nor what may be named.
    ranking_[even].gap_after = 0.111;
    EXPECT_THAT(after("what_cannot_be_parted", attributed(uneven)).effects, ElementsAre(uneven));
    ranking_[even].gap_after = 0.109;
    known_.objections[even] = "";
    EXPECT_THAT(after("what_cannot_be_parted", attributed(uneven)).effects, ElementsAre(even));
}

TEST_F(Rules, WhatCannotBePartedBesideAFormIsWhatGoesAsFar) {
    const std::size_t play = add({"backlash"}, 0.30, 900.0);
    const std::size_t curve = add({"input_curve"}, 0.35, 500.0);
    add({"supply_sag"}, 0.37, 500.0);
    const auto named = [&] { return after("what_cannot_be_parted", attributed(play)).effects; };
    set_noise(0.30 / 4.03);
    EXPECT_THAT(named(), ElementsAre(play));
    beside_a_form();
    EXPECT_THAT(named(), ElementsAre(play, curve));
    set_noise(0.30 / 3.97);  // a sensor's noise tells likelihoods, but for what goes as far to a twentieth
    EXPECT_THAT(named(), ElementsAre(play));
    ranking_[curve].gap_after = 0.3155;
    EXPECT_THAT(named(), ElementsAre(play));
    ranking_[curve].gap_after = 0.3145;
    EXPECT_THAT(named(), ElementsAre(play, curve));
    // Within a fifth more, and on this side of half the way back.
    set_noise(0.30 / 4.03);
    ranking_[curve].gap_after = 0.359;
    EXPECT_THAT(named(), ElementsAre(play, curve));
    ranking_[curve].gap_after = 0.361;
    EXPECT_THAT(named(), ElementsAre(play));
    ranking_[0].gap_after = 0.40;
    ranking_[curve].gap_after = 0.349;
    EXPECT_THAT(named(), ElementsAre(play, curve));
    ranking_[curve].gap_after = 0.3504;
    EXPECT_THAT(named(), ElementsAre(play));
}

// A curve is not the drive's own: beside a fitted base one in another's place may leave three times as much, whatever
// is noise.
TEST_F(Rules, WhatCannotBePartedBesideAFormIsAnotherCurve) {
    const std::size_t bend = add({"input_curve", "backlash"}, 0.10, 900.0);
    const std::size_t other = add({"backlash", "output_curve"}, 0.2995, 500.0);
    add({"backlash", "coulomb_friction"}, 0.2, 400.0);
    const auto named = [&] { return after("what_cannot_be_parted", attributed(bend)).effects; };
    EXPECT_THAT(named(), ElementsAre(bend));
    beside_a_form();
    EXPECT_THAT(named(), ElementsAre(bend, other));
    ranking_[other].gap_after = 0.3005;
    EXPECT_THAT(named(), ElementsAre(bend));
    // On this side of half the way back.
    ranking_[0].gap_after = 0.45;
    ranking_[other].gap_after = 0.2745;
    EXPECT_THAT(named(), ElementsAre(bend, other));
    ranking_[other].gap_after = 0.2755;
    EXPECT_THAT(named(), ElementsAre(bend));
}

// A play of the input and friction against a spring part where all moves quickly, which a misfit hides: to twice as
// much.
TEST_F(Rules, WhatCannotBePartedBesideAFormIsWhatLooksAlike) {
    const std::size_t play = add({"input_hysteresis", "input_curve"}, 0.10, 900.0);
    const std::size_t friction = add({"input_curve", "coulomb_friction"}, 0.199, 500.0);
    const auto named = [&] { return after("what_cannot_be_parted", attributed(play)).effects; };
    set_noise(0.10 / 7.03);
    EXPECT_THAT(named(), ElementsAre(play));
    beside_a_form();
    EXPECT_THAT(named(), ElementsAre(play, friction));
    ranking_[friction].gap_after = 0.201;
    EXPECT_THAT(named(), ElementsAre(play));
    ranking_[friction].gap_after = 0.199;
    set_noise(0.10 / 6.97);
    EXPECT_THAT(named(), ElementsAre(play));
}

// A valve that sticks and jumps is a play as long as it moves far.
TEST_F(Rules, WhatCannotBePartedBesideAFormIsAPlayOrAValveThatSticks) {
    const std::size_t play = add({"input_hysteresis"}, 0.10, 900.0);
    const std::size_t valve = add({"valve_stiction"}, 0.199, 500.0);
    ranking_[valve].trained.lasting[0][1].value = ranking_[valve].trained.lasting[0][0].value = 0.1;
    set_noise(0.10 / 7.03);
    beside_a_form();
    EXPECT_THAT(after("what_cannot_be_parted", attributed(play)).effects, ElementsAre(play, valve));
}

// A supply that is drawn from evenly sags with time.
TEST_F(Rules, WhatCannotBePartedBesideAFormIsASagOrADrift) {
    const std::size_t sag = add({"supply_sag"}, 0.10, 900.0);
    const std::size_t drift = add({"gain_drift"}, 0.199, 500.0);
    set_noise(0.10 / 7.03);
    beside_a_form();
    EXPECT_THAT(after("what_cannot_be_parted", attributed(sag)).effects, ElementsAre(sag, drift));
    ranking_[drift].gap_after = 0.201;
    EXPECT_THAT(after("what_cannot_be_parted", attributed(sag)).effects, ElementsAre(sag));
}

// The other way round, too; what stands in another one's place is no likeness.
TEST_F(Rules, WhatCannotBePartedBesideAFormIsFrictionOrAPlay) {
    const std::size_t friction = add({"quadratic_drag", "coulomb_friction"}, 0.10, 900.0);
    const std::size_t play = add({"input_hysteresis", "quadratic_drag"}, 0.199, 500.0);
    add({"input_hysteresis", "coulomb_friction"}, 0.199, 400.0);
    set_noise(0.10 / 7.03);
    beside_a_form();
    EXPECT_THAT(after("what_cannot_be_parted", attributed(friction)).effects, ElementsAre(friction, play));
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
    gap::Decision next = all;
    next.effects = {1, 2, 6, 5};  // the gain's is the first that has no place
    EXPECT_THAT(after("few_alternatives", next).effects, ElementsAre(1, 2, 5));
    beside_a_form();
    decision = after("few_alternatives", all);
    EXPECT_EQ(decision.outcome, Outcome::unknown);
    EXPECT_THAT(decision.notes, ElementsAre(HasSubstr("6 causes explain these records equally well: quadratic_drag")));
    all.effects.pop_back();
    decision = after("few_alternatives", all);  // those that go farthest
    EXPECT_THAT(decision.effects, ElementsAre(5, 4, 3));
    EXPECT_EQ(decision.chosen, 5u);
    EXPECT_THAT(decision.notes, SizeIs(1));
    for (const std::size_t i : all.effects) {
        ranking_[i].gap_after = 0.45;
    }
    EXPECT_THAT(after("few_alternatives", all).effects, ElementsAre(1, 2, 3));  // as far: the likelier first
    all.effects.resize(3);
    EXPECT_THAT(after("few_alternatives", all).notes, IsEmpty());
}

}  // namespace
