// Rules of the decision at their thresholds: which candidate is taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "rules_case.hpp"

namespace {

using gap::Outcome;
using gap_test::Rules;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST_F(Rules, HaveNamesOfTheirOwnAndReasons) {
    std::set<std::string> names;
    for (const gap::Rule& rule : gap::rules()) {
        EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
        EXPECT_THAT(rule.reason, HasSubstr(" ")) << rule.name;
        EXPECT_EQ(gap::rule_named(rule.name).apply, rule.apply);
    }
    EXPECT_THAT(names, SizeIs(14));
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

// Two steps of which neither is clear alone: both together are, and the second is no chance among its own rivals.
TEST_F(Rules, ClearAdvantageMayTakeTwoSteps) {
    add({"quadratic_drag"}, 0.7, 6.0);
    const std::size_t both = add({"quadratic_drag", "backlash"}, 0.4, 10.03);
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[both].by_sample.assign(samples, 9.97 / samples);
    EXPECT_THAT(after("clear_advantage").effects, IsEmpty());
    // In every block of samples, not in one.
    ranking_[both].by_sample.assign(samples, 6.0 / samples);
    ranking_[both].by_sample[7] += 5.0;
    EXPECT_THAT(after("clear_advantage").effects, IsEmpty());
    // Over none both have to be clear.
    ranking_[both - 1].by_sample.assign(samples, 3.0 / samples);
    ranking_[both].by_sample.assign(samples, 7.97 / samples);
    EXPECT_THAT(after("clear_advantage").effects, IsEmpty());
    ranking_[both].by_sample.assign(samples, 8.03 / samples);
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
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
    // A five-hundredth of what can be closed at least.
    ranking_[drag].gap_after = 0.004;
    ranking_[both].gap_after = 0.004 - 0.0021;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[both].gap_after = 0.004 - 0.0019;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
}

// Two that do nothing alone cancel each other together: of causes one at least goes a tenth of the way alone.
TEST_F(Rules, ClearAdvantageTakesNothingThatActsOnlyTogetherBesideAForm) {
    const std::size_t drag = add({"quadratic_drag"}, 0.91, 5.0);
    const std::size_t play = add({"backlash"}, 0.95, 3.0);
    const std::size_t both = add({"quadratic_drag", "backlash"}, 0.3, 200.0);
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    beside_a_form();
    EXPECT_EQ(after("clear_advantage").effects.size(), 0U);
    ranking_[drag].gap_after = 0.89;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[drag].gap_after = 0.91;
    ranking_[play].gap_after = 0.89;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    // What was never tried alone says nothing.
    ranking_[drag].trained.effects = ranking_[play].trained.effects = {&gap::effect_named("supply_sag")};
    ranking_[play].gap_after = 0.91;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
}

// What is as likely without one of two has that one for nothing, whether or not training tells the numbers of the rest.
TEST_F(Rules, ClearAdvantageTakesNothingThatIsAsLikelyWithoutIt) {
    const std::size_t drag = add({"quadratic_drag"}, 0.5, 50.0);
    const std::size_t drift = add({"sensor_drift"}, 0.2, 190.0);
    const std::size_t both = add({"quadratic_drag", "sensor_drift"}, 0.2, 196.0);
    known_.objections[drift] = "open";
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    beside_a_form();
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[drift].log_likelihood = 196.0;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
}

// The drive's own law is a little different from the listed one, and something else follows what that leaves.
TEST_F(Rules, ClearAdvantageTakesNothingOfTheShapeOfALawBesideAForm) {
    const std::size_t bend = add({"output_curve"}, 0.1595, 100.0);
    const std::size_t both = add({"output_curve", "quadratic_drag"}, 0.04, 200.0);
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    beside_a_form();
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(bend));
    ranking_[bend].gap_after = 0.1605;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    // Up to a quarter of the gap what follows a shape takes a part of it, and a cause takes half and more.
    ranking_[bend].gap_after = 0.248;
    ranking_[both].gap_after = 0.125;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(bend));
    ranking_[both].gap_after = 0.123;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[bend].gap_after = 0.252;
    ranking_[both].gap_after = 0.15;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[both].gap_after = 0.04;
    // What a log shows by itself follows no shape, and what goes without the law explains it otherwise.
    ranking_[bend].gap_after = 0.1595;
    ranking_[both].trained.effects[1] = &gap::effect_named("dropped_samples");
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[both].trained.effects[1] = &gap::effect_named("sampling_jitter");
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(bend));
    ranking_[both].trained.effects = {&gap::effect_named("gain_drift"), &gap::effect_named("quadratic_drag")};
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    // A wider law than the one that is taken is that law.
    ranking_[bend].trained.effects = {&gap::effect_named("coulomb_friction")};
    ranking_[both].trained.effects[0] = &gap::effect_named("direction_dependent_friction");
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(bend));
}

// What grows with time has no shape that the input shows again, nor follows one.
TEST_F(Rules, ClearAdvantageTakesADriftOfTheReadingsBesideAnyLaw) {
    const std::size_t bend = add({"output_curve"}, 0.1, 100.0);
    const std::size_t drift = add({"sensor_drift"}, 0.1, 99.0);
    const std::size_t both = add({"output_curve", "sensor_drift"}, 0.04, 200.0);
    beside_a_form();
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    known_.objections[bend] = "open";
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    // A gain that drifts bends what the input does.
    ranking_[drift].trained.effects = {&gap::effect_named("gain_drift")};
    ranking_[both].trained.effects[1] = &gap::effect_named("gain_drift");
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drift));
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
    // Two thousandths of the variance are what a form may leave itself.
    ranking_[0].gap_after = 0.27;
    ranking_[both].gap_after = 0.01;
    ranking_[drag].gap_after = 0.0449;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(both));
    ranking_[drag].gap_after = 0.0445;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(drag));
}

TEST_F(Rules, ClearAdvantageIsNoneWhereCleanReadingsLeaveAFormAsLittle) {
    const std::size_t drag = add({"quadratic_drag"}, 0.002, 50.0);
    const auto named = [&] { return after("clear_advantage").effects; };
    beside_a_form();
    ranking_[0].gap_after = 0.00702;
    EXPECT_THAT(named(), ElementsAre(drag));
    ranking_[0].gap_after = 0.00698;
    EXPECT_THAT(named(), IsEmpty());
    EXPECT_EQ(after("clear_advantage").outcome, Outcome::no_gap);
    ranking_[drag].trained.effects = {&gap::effect_named("sampling_jitter")};
    EXPECT_THAT(named(), IsEmpty());
    ranking_[drag].trained.effects = {&gap::effect_named("dropped_samples")};  // a fact of the log
    EXPECT_THAT(named(), ElementsAre(drag));
    ranking_[drag].trained.effects = {&gap::effect_named("quadratic_drag")};
    ground_.study.base.refit = ground_.validation.base.refit = false;
    EXPECT_THAT(named(), ElementsAre(drag));
}

TEST_F(Rules, ClearAdvantageOfAnEventIsNoneWhereAFormMayLeaveAsMuchItself) {
    const std::size_t load = add({"load_disturbance"}, 0.01, 50.0);
    beside_a_form();
    ranking_[0].gap_after = 0.0449;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(load));
    ranking_[0].gap_after = 0.0445;
    EXPECT_THAT(after("clear_advantage").effects, IsEmpty());
    ground_.study.base.refit = ground_.validation.base.refit = false;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(load));
}

// No plant jumps from one reading to the next: there half of the gap is enough.
TEST_F(Rules, ClearAdvantageOfAJumpOfReadingsIsHalfOfASmallGap) {
    const std::size_t jump = add({"missed_counts"}, 0.0221, 50.0);
    beside_a_form();
    ranking_[0].gap_after = 0.0445;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(jump));
    ranking_[jump].gap_after = 0.0224;
    EXPECT_THAT(after("clear_advantage").effects, IsEmpty());
    ranking_[0].gap_after = 0.0449;
    EXPECT_THAT(after("clear_advantage").effects, ElementsAre(jump));
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

}  // namespace
