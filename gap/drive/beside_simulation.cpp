#include "gap/drive/beside_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "gap/drive/fit.hpp"

namespace gap {
namespace {

bool rests(const drive::Form& form) { return drive::constant_coefficient(model_of(form).denominator) != 0.0; }

}  // namespace

// The base is what the user's own simulator gave; a model that reproduces it, without noise and so to a thousandth,
// says what each effect would change.
Answer answer_beside_simulation(Question question, const std::function<void(const std::string&)>& say) {
    double reproduced = 0.0;
    if (question.find) {
        Question of_simulation = question;
        double offset = 0.0;
        for (auto* records : {&of_simulation.train, &of_simulation.validate}) {
            for (Record& record : *records) {
                record.output = record.simulated;
                record.simulated.clear();
            }
        }
        const std::vector<Described> found = find_base(of_simulation, say);
        of_simulation.form = found.front().form;
        of_simulation.refit = true;
        const Ground ground = prepare(of_simulation);
        const Candidate fitted = fit(ground.study, {}, ground.base, nullptr);
        if (rests(found.front().form)) {
            offset = fitted.own.front().front().value;
        }
        reproduced = rms_of(ground.study, all_residuals(ground.study, fitted)) / output_deviation(ground.study);
        question.form = with_values(found.front().form, fitted);
        question.operating_output = offset;
        question.base_name = fmt::format("the simulation, as a {}", found.front().name);
    } else {
        question.base_name = "the simulation, with the given model";
    }
    question.find = question.refit = false;
    Answer answer = answer_to(question, say);
    answer.base_name = question.base_name;
    judge_reproduction(answer, reproduced);
    return answer;
}

void judge_reproduction(Answer& answer, double reproduced) {
    constexpr double poorly = 0.1;
    answer.notes.push_back(
        fmt::format("a model reproduces the simulation but for {:.2g} % of its deviation", 100.0 * reproduced));
    if (reproduced > poorly && answer.decision.outcome != Outcome::no_gap) {
        answer.decision.outcome = Outcome::unknown;
        answer.decision.suspect = answer.decision.chosen;
        answer.decision.effects.clear();
        answer.decision.confidence = std::min(answer.decision.confidence, 0.5);
        answer.notes.emplace_back("too poorly for effects to be told apart: where the gap lies is told all the same");
    }
}

}  // namespace gap
