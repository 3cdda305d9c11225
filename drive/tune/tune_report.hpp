// What was tuned, for people and as JSON.
#pragma once

#include <string>

#include "drive/tune/tune.hpp"

namespace tune {

/// Both controllers side by side, and in words what the fraction buys. \pre one of them was found
[[nodiscard]] std::string to_text(const Tuned& tuned, const std::string& name);

/// \param model  its file. What is infinite is left out.
[[nodiscard]] std::string to_json(const Tuned& tuned, const std::string& model);

/// What was wished for, on one line.
[[nodiscard]] std::string wish_text(const Tuned& tuned);

/// The fraction's use, in one sentence.
[[nodiscard]] std::string conclusion(const Tuned& tuned);

}  // namespace tune
