// generate --controller: a fractional PID as one C99 header.
#pragma once

#include <optional>
#include <string>

#include "cli/command.hpp"
#include "cli/output.hpp"

namespace cli {

struct ControllerOptions {
    std::string controller;
    std::string plant;  ///< a model file; empty: no loop is measured
    Output json;
    std::string out;
    std::string prefix;
    std::string licence;
    std::string core;  ///< of the timing model
    bool verify = false;
    double max_error = 0.0;   ///< 0: the usual one
    std::size_t samples = 0;  ///< 0: a million
    std::string format;       ///< empty: f32
    std::optional<double> input_scale;
};

/// \param command  as it was typed \throws glsum::Failure as the readers and `make_controller_header`
void generate_controller(const ControllerOptions& options, const std::string& command);

}  // namespace cli
