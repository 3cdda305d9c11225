// Choices for several machines beside each other: which of them can afford what.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/machines.hpp"
#include "bench/choose/question.hpp"

namespace choose {

/// A kernel at a length on one machine.
struct OnMachine {
    const base::Machine* machine;
    std::string core;  ///< core file
    double clock_hz;   ///< the core file's
    std::string kernel;
    std::size_t taps;
    std::string length;   ///< as names have it: "600", "2+7"
    Cost cost;            ///< model cycles a sample, and bytes
    bool chosen = false;  ///< it is the machine's choice

    [[nodiscard]] double microseconds() const { return 1e6 * cost.value / clock_hz; }
    /// Of the time from sample to sample, by the upper end of the band.
    [[nodiscard]] double share(double step_s) const { return cost.limited / (clock_hz * step_s); }
};

/// What was chosen for one machine or another, on each of them. \param boards  one for each answer
[[nodiscard]] std::vector<OnMachine> side_by_side(const std::vector<Answer>& answers,
                                                  const std::vector<qemu::Board>& boards);

/// A line each; machines for which nothing fits, with their nearest miss.
[[nodiscard]] std::string to_table(const std::vector<OnMachine>& rows, const std::vector<Answer>& answers);

/// Schema `glsum-choices-1`: each answer, and the rows of the table.
[[nodiscard]] bench::Json to_json(const std::vector<OnMachine>& rows, const std::vector<Answer>& answers);

}  // namespace choose
