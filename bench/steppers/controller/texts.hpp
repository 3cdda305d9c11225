// Files that a header of a controller holds, embedded by the build.
#pragma once

#include <string_view>

namespace generate {

extern const std::string_view pid_text;         ///< kernels/glsum/model/pid.h
extern const std::string_view pid_q31_text;     ///< kernels/glsum/model/pid_q31.h
extern const std::string_view controller_text;  ///< controller.h.in
extern const std::string_view scales_f32_text;  ///< scales_f32.h.in
extern const std::string_view scales_q31_text;  ///< scales_q31.h.in

}  // namespace generate
