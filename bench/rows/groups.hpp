// What can be read off the rows of a run: what each kernel does at each order and length.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/machines.hpp"
#include "bench/rows/row.hpp"

namespace bench {

/// Modelled cycles per sample, with the band over the rule sets that fit silicon equally.
struct ModelCycles {
    double median;
    std::optional<double> low;
    std::optional<double> high;
    const base::Machine* machine = &base::machines.front();
};

/// What one kernel does at one order and length.
struct Entry {
    std::string kernel;
    std::optional<double> error_max;           ///< worst of the signals
    std::optional<double> rounding_error_max;  ///< worst of the signals
    std::optional<double> truncation_error_max;
    std::optional<double> host_ns;              ///< median of the repetitions
    std::optional<double> host_cycles;          ///< likewise
    const base::Machine* counted_on = nullptr;  ///< the first of `base::machines` that it was counted on
    std::optional<double> target_instructions;  ///< there
    std::optional<double> target_worst;
    std::map<std::string, ModelCycles> model_cycles;  ///< by core
    std::optional<double> effective_taps;
    std::optional<double> bytes;  ///< state and coefficients; on the target where it runs there
    bool software_double = false;
    std::string fault;  ///< why it may not be ranked; empty if it may
    bool host_front = false;
    bool target_front = false;
};

/// All kernels of one order and length, in the order of their appearance.
struct Group {
    std::string order;
    std::string taps;
    std::vector<Entry> entries;
};

struct ModelledCore {
    const base::Machine* machine;
    std::string name;
};
/// The modelled cores of some groups: those of the first machine first, then by name.
[[nodiscard]] std::vector<ModelledCore> modelled_cores(std::span<const Group> groups);
/// The first machine that something of them was counted on; null: none.
[[nodiscard]] const base::Machine* counted_on(std::span<const Group> groups);

/// Groups by order and length, in the order of their appearance. Host timings, taken at one order, serve all;
/// of repetitions the median counts.
/// `host_front`, `target_front`: of the group nothing dominates it (front.hpp) by the host's time, or by the target's
/// modelled cycles or else its instructions.
[[nodiscard]] std::vector<Group> group(const std::vector<Json>& rows);

}  // namespace bench
