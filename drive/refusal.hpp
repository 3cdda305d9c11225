// How the readers of a log say what is wrong with it.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "base/failure.hpp"

namespace drive {

/// \throws glsum::Failure (bad input), always
[[noreturn]] inline void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

/// What was found, for a message: in quotes, and not endless.
inline std::string shown(std::string_view text) {
    return text.empty() ? "nothing" : fmt::format("'{}'", text.substr(0, 40));
}

}  // namespace drive
