// An answer beside the base that the records have by themselves.
#pragma once

#include <functional>
#include <string>

#include "gap/drive/answer.hpp"

namespace gap {

/// The search is done beside each base that is worth it; what leaves least, at a price for each number, is the answer.
/// \param question  without a form \throws glsum::Failure (bad input): nothing explains anything
[[nodiscard]] Answer answer_beside_found_base(Question question, const std::function<void(const std::string&)>& say);

/// Whether no further base is asked: nothing is missing. Of a disturbance another base may still know what it is.
[[nodiscard]] bool is_settled(const Decision& decision);

}  // namespace gap
