// Rankings made by hand, on which each rule of the decision is asked by itself.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gap/drive/decide/rule.hpp"
#include "gap/drive/question.hpp"
#include "stand_case.hpp"

namespace gap_test {

using gap::Outcome;

// A linear stand that is simulated well; what candidates leave of it and how likely they are is said.
class Rules : public testing::Test {
protected:
    Rules() : question_(question_of({}, {.seed = 31}, {.seed = 32})), ground_(gap::prepare(question_)) {
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
        known_.open[at] = false;
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

}  // namespace gap_test
