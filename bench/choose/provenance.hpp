// What a header says of where it comes from: all that someone needs to make it, and its numbers, again.
#pragma once

#include <string>
#include <vector>

#include "bench/choose/question.hpp"

namespace choose {

/// Lines of the header's comment. \param answer   with `chosen` set
/// \param command  as it was typed
[[nodiscard]] std::vector<std::string> provenance(const Answer& answer, const std::string& command);

}  // namespace choose
