// A model file with effects in it, and its simulation.
#pragma once

#include <string>
#include <vector>

#include "drive/model.hpp"
#include "gap/drive/record.hpp"

namespace gap {

struct Improved {
    std::vector<std::string> effects;
    std::vector<double>
        output;  ///< at the record's stamps; empty: the file has neither effects nor a point to be about
};

/// \param model  with fields `effects` ([{"effect", "parameters": {}}]) and `operating_output`, and `idle_input`,
/// which the record's input is counted from, among its notes
/// From rest. \throws glsum::Failure (bad input) naming the field: no such effect, a parameter that is missing, unknown
/// or no number. \param name  begins the message
[[nodiscard]] Improved simulate_improved(const drive::Model& model, Record record, const std::string& name);

}  // namespace gap
