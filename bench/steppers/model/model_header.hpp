// A model in single precision as one C99 header: a plant in real time.
#pragma once

#include <string>
#include <vector>

#include "bench/steppers/model/model_choice.hpp"
#include "bench/steppers/stepper/check_source.hpp"

namespace generate {

/// \param prefix  of every identifier \param lines  of the comment, behind what the header does; an empty one parts
/// \throws glsum::Failure (bad input) for a prefix that is no identifier
[[nodiscard]] std::string make_model_header(const ModelSpec& spec, const std::string& prefix,
                                            const std::string& licence, const std::vector<std::string>& lines);

/// \param text  the header of `spec` with this prefix
[[nodiscard]] WrittenStepper written(const ModelSpec& spec, const std::string& prefix, std::string text);

}  // namespace generate
