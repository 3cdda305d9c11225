#include "gap/drive/within_training.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace gap {
namespace {

// A gain, say, that is another one at another level leaves most of the gap there, whatever else is found; it says
// nothing against what both parts of the training show.
bool is_borne_out(const Answer& within) {
    constexpr double little = 0.2;
    constexpr double sure = 0.8;
    return within.decision.outcome == Outcome::attributed && within.decision.confidence >= sure &&
           !within.chosen().trained.has_events() && within.chosen().gap_after < little * within.none().gap_after;
}

}  // namespace

bool goes_elsewhere(const Answer& across) {
    return across.decision.outcome == Outcome::unknown && !across.extrapolated.empty();
}

Question of_training_alone(Question question) {
    question.validate.clear();
    if (question.split_s) {
        std::ranges::transform(question.train, question.train.begin(),
                               [&](const Record& record) { return up_to(record, *question.split_s); });
        question.split_s.reset();
    }
    return question;
}

Answer told_by_training(Answer across, Answer within) {
    if (!is_borne_out(within)) {
        return across;
    }
    constexpr double elsewhere = 0.7;
    within.decision.confidence = std::min(within.decision.confidence, elsewhere);
    within.notes.push_back(fmt::format(
        "judged by parts of the training: on the validation, which has {}, {:.4f} is left of {:.4f} whatever listed is "
        "added",
        fmt::join(across.extrapolated, " and "), across.decision.noise_floor, across.none().gap_after));
    within.extrapolated = std::move(across.extrapolated);
    within.next_experiment = std::move(across.next_experiment);
    within.next_record = std::move(across.next_record);
    return within;
}

}  // namespace gap
