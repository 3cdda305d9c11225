// How the search beside the bases that were found ends: which of them is the answer, and whether there is a gap at all.
#include "gap/drive/beside_found_base.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gap/drive/beside_simulation.hpp"

namespace {

using gap::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Names = std::vector<std::string>;

TEST(BesideFoundBase, IsSettledWhereNothingIsMissing) {
    const auto settled = [](Outcome outcome, bool disturbed) {
        gap::Decision decision;
        decision.outcome = outcome;
        decision.disturbed = disturbed;
        return gap::is_settled(decision);
    };
    EXPECT_TRUE(settled(Outcome::no_gap, false));
    EXPECT_FALSE(settled(Outcome::no_gap, true));
    for (const Outcome outcome : {Outcome::attributed, Outcome::ambiguous, Outcome::unknown}) {
        EXPECT_FALSE(settled(outcome, false));
        EXPECT_FALSE(settled(outcome, true));
    }
}

gap::Described description(double validation) { return {"", "", gap::form_to_find(), 0.0, validation, 2, 0}; }

// Half of the output, and half of that which is left without signs.
TEST(BesideFoundBase, AsksForLostSignsWhereMostIsLeft) {
    EXPECT_FALSE(gap::leaves_most(description(0.5)));
    EXPECT_TRUE(gap::leaves_most(description(0.501)));
    EXPECT_TRUE(gap::leaves_half_of(0.299, 0.6));
    EXPECT_FALSE(gap::leaves_half_of(0.3, 0.6));
}

// 1 less the gap's square.
TEST(BesideFoundBase, IsLinearAsFarAsTheBestDescriptionGoes) {
    const std::vector<gap::Described> found{description(0.5), description(0.25), description(0.75)};
    EXPECT_DOUBLE_EQ(gap::best_linear_share(0.125, found), 0.9375);
    EXPECT_DOUBLE_EQ(gap::best_linear_share(0.96875, found), 0.96875);
}

// Nothing leaves 1; each list of causes, an alternative of the answer, leaves `gap_after`.
gap::Answer answer_of(const std::vector<Names>& alternatives, double gap_after) {
    gap::Answer answer{};
    answer.ranking.resize(1 + alternatives.size());
    for (std::size_t i = 0; i < alternatives.size(); ++i) {
        for (const std::string& name : alternatives[i]) {
            answer.ranking[i].trained.effects.push_back(&gap::effect_named(name));
        }
        answer.ranking[i].gap_after = gap_after;
        answer.decision.effects.push_back(i);
    }
    answer.ranking.back().gap_after = 1.0;
    answer.decision.outcome = alternatives.empty()       ? Outcome::no_gap
                              : alternatives.size() == 1 ? Outcome::attributed
                                                         : Outcome::ambiguous;
    answer.decision.confidence = 0.97;
    answer.next_experiment = "the same record once more";
    answer.next_record.emplace();
    return answer;
}

// The gap's logarithm and 8 % for each number, of the base and of effects, of an event in each record; what is below a
// ten-thousandth is no less.
TEST(BesideFoundBase, CostsItsGapAndItsNumbers) {
    gap::Answer answer = answer_of({{"gain_error"}}, 0.25);
    EXPECT_NEAR(gap::price_of(answer, 0), std::log(0.25), 1e-12);
    EXPECT_NEAR(gap::price_of(answer, 5), std::log(0.25) + 5 * 0.08, 1e-12);
    gap::Candidate& candidate = answer.ranking[0].candidate;
    const auto number = [](const char* name, bool fixed = false) {
        return gap::FreeParameter{.name = name, .value = 0.5, .lower = 0.0, .upper = 1.0, .scale = 1.0, .fixed = fixed};
    };
    candidate.base = {number("gain")};  // counted with the base
    candidate.lasting = {{number("gain_error.gain"), number("order_error.power", true)}};
    candidate.own.assign(3, {number("initial_output"), number("load_disturbance.size")});
    EXPECT_NEAR(gap::price_of(answer, 5), std::log(0.25) + (5 + 1 + 3) * 0.08, 1e-12);
    answer.ranking[0].gap_after = 1.0002e-4;
    EXPECT_NEAR(gap::price_of(answer, 0), std::log(1.0002e-4) + 4 * 0.08, 1e-12);
    answer.ranking[0].gap_after = 0.9e-4;
    EXPECT_NEAR(gap::price_of(answer, 0), std::log(1e-4) + 4 * 0.08, 1e-12);
}

gap::Answer cheapest(const std::vector<std::pair<double, std::vector<Names>>>& tried) {
    std::vector<gap::BesideABase> all;
    for (const auto& [price, causes] : tried) {
        all.push_back({"base_" + std::to_string(all.size() + 1), answer_of(causes, 0.1), price});
    }
    return gap::cheapest_of(std::move(all));
}

// Of two that cost the same the one that was asked first.
TEST(BesideFoundBase, TheCheapestIsTheAnswer) {
    const gap::Answer found = cheapest({{1.5, {{"backlash"}}}, {0.5, {{"gain_drift"}}}, {0.5, {{"gain_drift"}}}});
    EXPECT_EQ(found.base_name, "base_2");
    EXPECT_EQ(found.ranking[0].trained.effects[0]->name, "gain_drift");
    EXPECT_EQ(found.decision.confidence, 0.97);
    EXPECT_THAT(found.notes, IsEmpty());
}

// Another cause that costs less than a fifth more, in logarithms.
TEST(BesideFoundBase, IsLessSureBesideAnotherCauseThatGoesAsFar) {
    const auto found = [](double more, const std::vector<Names>& theirs,
                          const std::vector<Names>& ours = {{"backlash"}}) {
        gap::Answer answer = cheapest({{-2.0 + more, theirs}, {-2.0, ours}});
        EXPECT_EQ(answer.base_name, "base_2");
        EXPECT_EQ(answer.decision.confidence, answer.notes.empty() ? 0.97 : 0.6);
        return answer.notes;
    };
    EXPECT_THAT(found(0.199, {{"gain_drift"}}), ElementsAre("beside the base base_1 gain_drift goes about as far"));
    EXPECT_THAT(found(0.201, {{"gain_drift"}}), IsEmpty());
    // All that it may be are told; the same ones, or more general ones, are no others.
    EXPECT_THAT(found(0.1, {{"gain_drift", "backlash"}, {"backlash", "end_stop"}}),
                ElementsAre(HasSubstr("base_1 gain_drift + backlash + end_stop goes")));
    EXPECT_THAT(found(0.1, {{"backlash"}}), IsEmpty());
    EXPECT_THAT(found(0.1, {{"backlash"}}, {{"backlash", "gain_drift"}}), ElementsAre(HasSubstr(" backlash goes")));
    EXPECT_THAT(found(0.1, {{"direction_dependent_friction"}}, {{"coulomb_friction"}}), IsEmpty());
    EXPECT_THAT(found(0.1, {{"coulomb_friction"}}, {{"direction_dependent_friction"}}), IsEmpty());
    // Where either names nothing there is nothing to compare.
    EXPECT_THAT(found(0.1, {}), IsEmpty());
    EXPECT_THAT(found(0.1, {{"backlash"}}, {}), IsEmpty());
    // What was less sure stays so.
    std::vector<gap::BesideABase> unsure{{"a", answer_of({{"backlash"}}, 0.1), 0.0},
                                         {"b", answer_of({{"gain_drift"}}, 0.1), 0.1}};
    unsure[0].answer.decision.confidence = 0.5;
    EXPECT_EQ(gap::cheapest_of(unsure).decision.confidence, 0.5);
}

// A base that sees the validation, too, leaves within 15 % of what the effect does, and a tenth of the gap at most, or
// what a form may leave. Of training that goes one way only, where validation does not, it is a quarter.
TEST(BesideFoundBase, NeedsNoCauseWhereTheBaseDoesAsWellOnAll) {
    const auto is_none = [](double after, double jointly, const Names& extrapolated = {}, double before = 1.0) {
        gap::Answer answer = answer_of({{"backlash"}}, after);
        answer.ranking.back().gap_after = before;
        answer.extrapolated = extrapolated;
        gap::judge_jointly(answer, jointly);
        return answer.decision.outcome == Outcome::no_gap;
    };
    EXPECT_TRUE(is_none(0.03, 1.1499 * 0.03));
    EXPECT_FALSE(is_none(0.03, 1.1501 * 0.03));
    EXPECT_TRUE(is_none(0.5, 0.0446));
    EXPECT_FALSE(is_none(0.5, 0.0448));
    EXPECT_FALSE(is_none(0.5, 0.0448, {"input above 1", "output above 2"}));
    EXPECT_TRUE(is_none(0.1, 0.0299, {}, 0.3));
    EXPECT_FALSE(is_none(0.1, 0.0301, {}, 0.3));
    // What leaves most of the output explains nothing, however far the base has run away.
    EXPECT_TRUE(is_none(12.0, 0.2499, {"falling output"}, 12.0));
    EXPECT_FALSE(is_none(12.0, 0.2501, {"falling output"}, 12.0));
    for (const char* way : {"falling output", "rising output"}) {
        EXPECT_TRUE(is_none(0.5, 0.2499, {"input above 1", way})) << way;
        EXPECT_FALSE(is_none(0.5, 0.2501, {way})) << way;
    }
}

TEST(BesideFoundBase, WithoutACauseNamesNothing) {
    gap::Answer answer = answer_of({{"backlash"}, {"gain_drift"}}, 0.1);
    answer.decision.suspect = 1;
    gap::judge_jointly(answer, 0.0425);
    EXPECT_EQ(answer.decision.outcome, Outcome::no_gap);
    EXPECT_EQ(answer.decision.chosen, 2U);  // none
    EXPECT_EQ(&answer.chosen(), &answer.none());
    EXPECT_THAT(answer.decision.effects, IsEmpty());
    EXPECT_FALSE(answer.decision.suspect);
    EXPECT_EQ(answer.decision.confidence, 0.9);
    EXPECT_FALSE(answer.next_record);
    EXPECT_EQ(answer.next_experiment,
              "none for this gap; a longer training record would tell the base's numbers by itself");
    EXPECT_THAT(answer.notes, ElementsAre(HasSubstr("fitted to the validation, too, the base leaves 0.0425 without")));
    // What training lacks is what to train on; what was less sure stays so.
    gap::Answer lacking = answer_of({{"backlash"}}, 0.1);
    lacking.decision.confidence = 0.7;
    lacking.extrapolated = {"falling output", "input above 1"};
    gap::judge_jointly(lacking, 0.0625);
    EXPECT_EQ(lacking.decision.confidence, 0.7);
    EXPECT_EQ(lacking.next_experiment, "train on what validation alone has, too: falling output; input above 1");
    // Otherwise nothing is touched.
    gap::Answer kept = answer_of({{"backlash"}}, 0.1);
    gap::judge_jointly(kept, 0.5);
    EXPECT_EQ(kept.decision.outcome, Outcome::attributed);
    EXPECT_TRUE(kept.next_record);
    EXPECT_THAT(kept.notes, IsEmpty());
}

// Beyond a tenth of the simulation's deviation effects are not told from what the model lacks.
TEST(BesideSimulation, NamesNothingWhereItIsReproducedPoorly) {
    gap::Answer well = answer_of({{"backlash"}}, 0.1);
    gap::judge_reproduction(well, 0.1);
    EXPECT_EQ(well.decision.outcome, Outcome::attributed);
    EXPECT_THAT(well.notes, ElementsAre("a model reproduces the simulation but for 10 % of its deviation"));
    gap::Answer poorly = answer_of({{"gain_drift"}, {"backlash"}}, 0.1);
    poorly.decision.chosen = 1;
    gap::judge_reproduction(poorly, 0.1001);
    EXPECT_EQ(poorly.decision.outcome, Outcome::unknown);
    EXPECT_EQ(poorly.decision.suspect, 1U);
    EXPECT_THAT(poorly.decision.effects, IsEmpty());
    EXPECT_EQ(poorly.decision.confidence, 0.5);
    EXPECT_THAT(poorly.notes, ElementsAre(HasSubstr("10 %"), HasSubstr("too poorly")));
    gap::Answer unsure = answer_of({{"backlash"}}, 0.1);
    unsure.decision.confidence = 0.4;
    gap::judge_reproduction(unsure, 0.2);
    EXPECT_EQ(unsure.decision.confidence, 0.4);
    gap::Answer none = answer_of({}, 0.1);
    gap::judge_reproduction(none, 0.2);
    EXPECT_EQ(none.decision.outcome, Outcome::no_gap);
}

}  // namespace
