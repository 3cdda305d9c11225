// glsum identify --coverage: whether intervals hold what they promise.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "cli/command.hpp"
#include "cli/output.hpp"
#include "drive/coverage.hpp"

namespace cli {

struct CoverageOptions {
    std::size_t runs = 0;  ///< 0: not asked for
    drive::Acquisition acquisition;
};

/// --coverage, --input, --until-s, --interval-s, --jitter-s, --noise, --quantum. \param options  outlives the run
void add_coverage_options(Command& command, CoverageOptions& options);

/// What is fitted, and how it is told.
struct Covered {
    std::string model;  ///< the truth's file
    std::string form;
    std::uint64_t seed;
    unsigned jobs;
    const Output& json;
    std::filesystem::path out;
};

/// \throws glsum::Failure (check failed) after all is told, where of 100 runs or more too few or too many hold
void show_coverage(const CoverageOptions& options, const Covered& covered);

}  // namespace cli
