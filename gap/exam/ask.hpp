// A question of an exam put to the diagnosis, and its answer as a file.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drive/model.hpp"
#include "gap/drive/diagnose.hpp"
#include "gap/exam/manifest.hpp"

namespace gap::exam {

/// What a question's paths hold.
struct Given {
    std::vector<Record> train;
    std::vector<Record> validate;
    std::optional<drive::Model> model;  ///< where the base is a file
};

/// \throws glsum::Failure (bad input): a split with fewer than 32 samples of a log on a side, or a base that cannot be
/// fitted
[[nodiscard]] Question to_question(const Asked& asked, Given given, unsigned jobs);

/// The verdict's file with the question beside it, in a field `question`.
[[nodiscard]] std::string to_answer(const Asked& asked, const Answer& answer);

}  // namespace gap::exam
