// From a question to its answer: which base it is asked beside.
#pragma once

#include <functional>
#include <string>

#include "gap/drive/answer.hpp"

namespace gap {

/// \throws glsum::Failure (bad input): records and model that cannot belong together: a dead time as long as the
/// record, stamps or readings in other units, a model that runs away. \param say  told of progress
[[nodiscard]] Answer diagnose(Question question, const std::function<void(const std::string&)>& say);

}  // namespace gap
