// One experiment, as identification takes it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drive/log.hpp"
#include "drive/model.hpp"
#include "drive/response.hpp"

namespace drive {

/// One experiment, from rest: the held input and the stamps' outputs. Stamps need not be even.
struct Record {
    std::string name;
    std::vector<Change> changes;
    std::vector<double> time_s;  ///< from the first stamp
    std::vector<double> output;
    /// In a closed loop: what made the input of the reference and the output. Then `changes` are the reference's.
    std::optional<Model> controller = {};
    std::vector<double> reference = {};  ///< at the stamps
};

/// \param controller  of a closed loop; the reference is the log's, or else what its input and output leave no choice
/// about (`recover_reference`)
/// \throws glsum::Failure (bad input) where nothing can be identified: an input or reference that never changes from 0,
/// an output that never moves, fewer than 8 samples.
[[nodiscard]] Record to_record(const Log& log, const std::optional<Model>& controller = {});

/// What a model, and in a closed loop the record's controller, make of a record's input or reference. \param offset  of
/// the readings
[[nodiscard]] std::vector<double> respond_to(const Model& model, const Record& record, double offset = 0.0);

}  // namespace drive
