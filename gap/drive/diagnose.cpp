#include "gap/drive/diagnose.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "base/failure.hpp"
#include "gap/drive/base/idle.hpp"
#include "gap/drive/beside_found_base.hpp"
#include "gap/drive/beside_simulation.hpp"
#include "gap/drive/within_training.hpp"

namespace gap {
namespace {

void check_simulated(const Question& question) {
    std::size_t with = 0;
    for (const auto* records : {&question.train, &question.validate}) {
        for (const Record& record : *records) {
            with += record.simulated.empty() ? 0 : 1;
        }
    }
    if (with != 0 && with != question.train.size() + question.validate.size()) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("expected what was simulated in every log, found it in {} of {}", with,
                                         question.train.size() + question.validate.size()));
    }
}

// The training may be too short to be parted, or still in what is kept aside: it then tells nothing more.
std::optional<Answer> answer_of_training_alone(Question question, const std::function<void(const std::string&)>& say) {
    try {
        return answer_beside_found_base(of_training_alone(std::move(question)), say);
    } catch (const glsum::Failure& failure) {
        if (failure.status() != glsum::Exit::bad_input) {
            throw;
        }
        return {};
    }
}

}  // namespace

Answer diagnose(Question question, const std::function<void(const std::string&)>& say) {
    check_simulated(question);
    if (!question.train.front().simulated.empty()) {
        return answer_beside_simulation(std::move(question), say);
    }
    if (question.find || question.refit) {
        question = counted_from_idle(std::move(question));
    }
    if (question.find) {
        Answer across = answer_beside_found_base(question, say);
        if (!goes_elsewhere(across)) {
            return across;
        }
        say("validation goes where training never was: the training alone");
        std::optional<Answer> within = answer_of_training_alone(std::move(question), say);
        return within ? told_by_training(std::move(across), std::move(*within)) : across;
    }
    Answer answer = answer_to(question, say);
    answer.base_name = question.base_name;
    return answer;
}

}  // namespace gap
