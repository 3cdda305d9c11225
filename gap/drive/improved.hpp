// A model file with effects in it, and its simulation.
#pragma once

#include <string>
#include <vector>

#include "drive/model.hpp"
#include "gap/drive/record.hpp"

namespace gap {

struct Improved {
    std::vector<std::string> effects;  ///< empty: the file has none
    std::vector<double> output;        ///< at the record's stamps
};

/// \param model  with fields `effects` ([{"effect", "parameters": {}}]) and `operating_output` among its notes
/// From rest. \throws glsum::Failure (bad input) naming the field: no such effect, a parameter that is missing, unknown
/// or no number. \param name  begins the message
[[nodiscard]] Improved simulate_improved(const drive::Model& model, const Record& record, const std::string& name);

}  // namespace gap
