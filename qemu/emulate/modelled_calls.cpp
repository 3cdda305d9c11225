#include "qemu/emulate/modelled_calls.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/failure.hpp"

namespace qemu {

std::vector<ModelledCall> modelled_calls(const timing::TimingLog& log, const firmware::TimedCalls& timed,
                                         std::size_t calls, std::size_t cores, std::uint64_t first_instructions,
                                         const std::string& what, std::size_t answers) {
    const auto fault = [&](const std::string& found) {
        return glsum::Failure(glsum::Exit::check_failed, fmt::format("the timing model, {}: {}", what, found));
    };
    std::vector<ModelledCall> row(cores);
    std::vector<std::vector<double>> sets(cores);  // cycles of the steady calls, by rule set
    const auto share = 1.0 / static_cast<double>(timed.steady());
    auto run = log.runs.begin();
    std::uint64_t used = 0;
    for (std::size_t call = 0; call < calls; ++call) {
        if (!timed.contains(call)) {
            continue;
        }
        if (run == log.runs.end() || run->call.cores.size() != cores) {
            throw fault("it saw fewer calls than the program marked");
        }
        if (call == 0 && run->call.instructions != first_instructions) {
            throw fault(fmt::format("its first call has {} instructions, the counter's {}", run->call.instructions,
                                    first_instructions));
        }
        for (std::size_t c = 0; c < cores; ++c) {
            const timing::CoreTime& time = run->call.cores[c];
            ModelledCall& modelled = row[c];
            const double cycles = static_cast<double>(time.half_cycles.at(0)) / 2.0;
            if (call == 0) {
                modelled.first_cycles = cycles;
            } else if (timed.is_full(call)) {
                modelled.worst_cycles = std::max(modelled.worst_cycles, cycles);
            }
            if (timed.is_steady(call)) {
                sets[c].resize(time.half_cycles.size());
                for (std::size_t s = 0; s < sets[c].size(); ++s) {
                    sets[c][s] += share * static_cast<double>(time.half_cycles[s]) / 2.0;
                }
                for (std::size_t e = 0; e < timing::effect_count; ++e) {
                    modelled.lost[e] += share * static_cast<double>(time.losses[e]) / 2.0;
                }
                modelled.double_in_software += share * static_cast<double>(time.double_in_software) / 2.0;
            }
        }
        if (++used == run->calls) {
            ++run;
            used = 0;
        }
    }
    for (std::size_t seen = 0; seen < answers; ++seen) {
        if (run == log.runs.end() || run->call.cores.size() != cores) {
            throw fault("it saw fewer first halves than the program marked");
        }
        for (std::size_t c = 0; c < cores; ++c) {
            row[c].latency_cycles +=
                static_cast<double>(run->call.cores[c].half_cycles.at(0)) / 2.0 / static_cast<double>(answers);
        }
        if (++used == run->calls) {
            ++run;
            used = 0;
        }
    }
    if (run != log.runs.end()) {
        throw fault("it saw more calls than the program marked");
    }
    for (std::size_t c = 0; c < cores; ++c) {
        row[c].cycles = sets[c].at(0);
        const auto [low, high] = std::minmax_element(sets[c].begin(), sets[c].end());
        row[c].low = *low;
        row[c].high = *high;
        row[c].latency_cycles = answers > 0 ? row[c].latency_cycles : row[c].cycles;
    }
    return row;
}

}  // namespace qemu
