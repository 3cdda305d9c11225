// glsum generate --model: a plant in real time as one C99 header.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "cli/output.hpp"

namespace cli {

struct ModelOptions {
    std::string model;
    Output json;
    std::string out;
    std::string prefix;
    std::string licence;
    std::string core;
    bool verify;
    double max_error;     ///< 0: 1e-3
    double step_s;        ///< 0: the file's sample_time_s
    std::size_t samples;  ///< 0: 60 000
    std::string format;   ///< empty: f32
    std::optional<double> input_scale;
};

/// \throws glsum::Failure (check failed) where no length keeps the error, or bits are not the library's
void generate_model(const ModelOptions& options, const std::string& command);

}  // namespace cli
