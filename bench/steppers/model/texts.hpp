// Files that a header of a model holds, embedded by the build.
#pragma once

#include <string_view>

namespace generate {

extern const std::string_view model_text;      ///< model.h.in
extern const std::string_view model_q31_text;  ///< model_q31.h.in

}  // namespace generate
