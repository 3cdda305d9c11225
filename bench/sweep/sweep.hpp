// What a run measures.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/machines.hpp"
#include "bench/rows/key.hpp"
#include "bench/sweep/discretisation.hpp"
#include "glsum/kernel.hpp"

namespace bench {

/// A memory length: a number of taps, all of the record, or near taps and modes, each of these counting as two taps, or
/// near taps and blocks, each counting as one.
struct Length {
    std::size_t taps;
    bool full = false;
    std::optional<std::size_t> modes = {};
    std::optional<glsum::Blocks> blocks = {};
    /// Whether it is a window's.
    [[nodiscard]] bool window() const { return !modes && !blocks; }
    /// "600", "full", "2+7"; which kind the last is, the kernel says.
    [[nodiscard]] std::string text() const {
        return full     ? "full"
               : blocks ? std::to_string(taps - blocks->count) + '+' + std::to_string(blocks->count)
               : modes  ? std::to_string(taps - 2 * *modes) + '+' + std::to_string(*modes)
                        : std::to_string(taps);
    }
};

/// Beyond any record; tables and windows still fit the memory.
inline constexpr std::size_t longest_length = 1'000'000;

/// The length that `text` writes; `full` is that of a record of `samples`. Empty for what is none: of 1 to
/// `longest_length` taps, before a plus at least one.
[[nodiscard]] std::optional<Length> parse_length(const std::string& text, std::size_t samples);

struct Sweep {
    std::vector<std::string> kernels;  ///< in the registry's order; may hold `null`
    std::vector<std::string> peers;
    std::vector<double> orders;
    std::vector<Length> lengths;  ///< rising
    /// Kernels with modes, unless `lengths` has some of theirs: the largest errors of the sum for |x| <= 1 that they
    /// are designed for, over the record.
    std::vector<double> design_errors{1e-2, 1e-3, 1e-4, 1e-6};
    std::vector<std::string> signals;
    std::vector<std::string> targets{"host", "m7"};  ///< where the cost is measured: host, words of machines
    /// On the emulated machines: cores of the timing model, and `count` for instructions alone; not empty.
    std::vector<std::string> cores{count_only};
    /// Whose machine is not the first one: its word.
    std::map<std::string, std::string> machine_of_core = {};
    std::size_t samples = 5000;
    std::uint64_t seed = 2020;
    Discretisation weights = Discretisation::gl;  ///< which every kernel and peer sums
    unsigned repetitions = 1;                     ///< of each host timing
    unsigned jobs = 1;
    /// Those of `cores` that are modelled.
    [[nodiscard]] std::vector<std::string> modelled_cores() const {
        std::vector<std::string> modelled;
        std::copy_if(cores.begin(), cores.end(), std::back_inserter(modelled),
                     [](const std::string& core) { return core != count_only; });
        return modelled;
    }
    /// Those of `cores` that are modelled on a machine, or counted there.
    [[nodiscard]] std::vector<std::string> cores_on(const base::Machine& machine) const {
        std::vector<std::string> here;
        std::copy_if(cores.begin(), cores.end(), std::back_inserter(here), [&](const std::string& core) {
            const auto found = machine_of_core.find(core);
            const std::string_view word =
                found == machine_of_core.end() ? base::machines.front().word : std::string_view(found->second);
            return core == count_only || word == machine.word;
        });
        return here;
    }
    [[nodiscard]] bool wants(std::string_view target) const {
        return std::find(targets.begin(), targets.end(), target) != targets.end();
    }
    /// The emulated machines among the targets, in the order of `base::machines`.
    [[nodiscard]] std::vector<const base::Machine*> machines() const {
        std::vector<const base::Machine*> wanted;
        for (const base::Machine& machine : base::machines) {
            if (wants(machine.word)) {
                wanted.push_back(&machine);
            }
        }
        return wanted;
    }
};

/// Of a sum's row; the order in its shortest round-trip form.
[[nodiscard]] RowKey row_key(const std::string& kernel, double order, const Length& length, std::string_view aspect);

}  // namespace bench
