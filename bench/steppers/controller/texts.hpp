// Files that a header of a controller holds, embedded by the build.
#pragma once

#include <string_view>

namespace generate {

extern const std::string_view pid_text;         ///< kernels/glsum/model/pid.h
extern const std::string_view controller_text;  ///< controller.h.in

}  // namespace generate
