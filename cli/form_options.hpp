// What a person says of a form's parameters: which are fixed or free, where they start, and between which bounds.
#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"
#include "drive/form.hpp"

namespace cli {

struct FormOptions {
    std::vector<std::string> fix;
    std::vector<std::string> free;
    std::vector<std::string> set;
    std::vector<std::string> bounds;
};

/// --fix, --free, --set, --bound. \param options  outlives the run
void add_form_options(Command& command, FormOptions& options);

/// \throws glsum::Failure (bad input) naming the option, what it expects and what it found
void apply(const FormOptions& options, drive::Form& form);

}  // namespace cli
