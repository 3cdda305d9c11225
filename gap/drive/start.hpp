// A base model without any: of a form, from records that need not begin at rest.
#pragma once

#include <string>
#include <vector>

#include "drive/fit.hpp"
#include "gap/drive/base/find.hpp"
#include "gap/drive/question.hpp"

namespace gap {

/// \param form  fopdt, sopdt, niopdt (which begins as a sopdt), integrator: gain / (s (1 + T s)) with a dead time, or a
/// structure by its name (gap/drive/base/structure.hpp)
/// The time constant and the dead time of a grid for which gain, offset and initial output, which are linear, leave the
/// least sum of squares. \throws glsum::Failure (bad input): another form, or no gain explains anything.
[[nodiscard]] drive::Form search_form(const std::string& form, const std::vector<Record>& records);

/// Takes the base of a question as it is asked for, from its training records: `fit`, looked for; `fit:FORM`, of a
/// form.
void take_base(Question& question, const std::string& words);

/// The form of a model that is given: its integer orders stay.
[[nodiscard]] drive::Form form_of(const drive::Model& model);

}  // namespace gap
