// What is refused before anything is diagnosed.
#pragma once

#include "gap/drive/study.hpp"

namespace gap {

/// \throws glsum::Failure (bad input) naming the record and what does not belong: a dead time as long as the record,
/// stamps or readings that look like other units than the model's, a model that runs away on this input.
void check_plausible(const Study& study);

}  // namespace gap
