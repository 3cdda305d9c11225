// glsum gate --elf: functions of anybody's program held to a baseline, in place of the rows of a run.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/gate/verdict.hpp"
#include "cli/timed_elf.hpp"

namespace cli {

struct GatedElf {
    TimedElf timed;
    std::vector<std::string> functions;  ///< globs of their names
    std::filesystem::path baseline;
    bool update = false;  ///< record it in place of judging
    std::string reason;
};

/// \param write  told the verdict once it stands, also one that could not judge \param is_text  whether it is printed,
/// too \throws glsum::Failure (check failed) where a function grew, (bad input) for programs, baselines and names that
/// are not there, (not comparable) for a baseline of another core or placement
void gate_functions(const GatedElf& options, const std::function<void(const bench::gate::Verdict&)>& write,
                    bool is_text);

}  // namespace cli
