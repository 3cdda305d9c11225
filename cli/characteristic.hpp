// glsum identify --static: where the output rests for each level of the input.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/command.hpp"
#include "drive/log.hpp"

namespace cli {

struct CharacteristicOptions {
    bool asked = false;
    double shortest_hold_s = 1.0;
};

/// --static, --hold-s. \param options  outlives the run
void add_characteristic_options(Command& command, CharacteristicOptions& options);

/// Of the one log. \param out  for its levels as CSV; may be empty, as `plot` may
void show_characteristic(const CharacteristicOptions& options, const std::vector<std::filesystem::path>& logs,
                         const drive::Columns& columns, const std::filesystem::path& out,
                         const std::filesystem::path& plot);

}  // namespace cli
