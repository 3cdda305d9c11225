#include "bench/report/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bench {
namespace {

std::string error(std::optional<double> value) { return value ? fmt::format("{:.2e}", *value) : "-"; }

std::string count(std::optional<double> value, const char* form) {
    return value ? fmt::format(fmt::runtime(form), *value) : "-";
}

using Cores = std::vector<ModelledCore>;

// "M7", "M4"
std::string short_name(const base::Machine& machine) {
    return std::string(machine.name.substr(machine.name.rfind('-') + 1));
}

// Instructions and the most of them; of modelled cores the cycles and the band over the rule sets instead of the
// latter.
std::string target_cells(const Entry& entry, const Cores& cores) {
    const char mark = entry.target_front ? '*' : ' ';
    if (cores.empty()) {
        return fmt::format("  {:>10}{} {:>10}", count(entry.target_instructions, "{:.1f}"), mark,
                           count(entry.target_worst, "{:.0f}"));
    }
    std::string cells = fmt::format("  {:>10}", count(entry.target_instructions, "{:.1f}"));
    for (const ModelledCore& core : cores) {
        const auto found = entry.model_cycles.find(core.name);
        const bool known = found != entry.model_cycles.end();
        const std::string band = known && found->second.low && found->second.high
                                     ? fmt::format("{:.0f} to {:.0f}", *found->second.low, *found->second.high)
                                     : "-";
        cells += fmt::format("  {:>9}{} {:>17}", known ? fmt::format("{:.1f}", found->second.median) : "-",
                             &core == cores.data() ? mark : ' ', band);
    }
    return cells;
}

std::string line_of(const Entry& entry, const Cores& cores) {
    const bool ranked = entry.error_max && entry.fault.empty();
    const bool dominated = ranked && !entry.host_front && !entry.target_front;
    std::string note = entry.fault;  // from a file: without what would steer a terminal
    std::replace_if(
        note.begin(), note.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    if (note.empty() && entry.software_double) {
        note = fmt::format("double in software on the {}",
                           short_name(entry.counted_on != nullptr ? *entry.counted_on : base::machines.front()));
    }
    if (dominated) {
        note = note.empty() ? "dominated" : "dominated; " + note;
    }
    std::string line =
        fmt::format("  {:<25} {:>9} {:>9}  {:>9}{} {:>9}{}  {:>8}  {}", entry.kernel, error(entry.error_max),
                    error(entry.rounding_error_max), count(entry.host_ns, "{:.1f}"), entry.host_front ? '*' : ' ',
                    count(entry.host_cycles, "{:.0f}"), target_cells(entry, cores), count(entry.bytes, "{:.0f}"), note);
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

std::string heading_of(const Group& group, const Cores& cores) {
    std::string text = fmt::format("\norder {}, {} taps", group.order, group.taps);
    const base::Machine* const machine = counted_on({&group, 1});
    const std::string counted = short_name(machine != nullptr ? *machine : base::machines.front());
    std::string target = fmt::format("  {:>10}", counted + " instr.");
    if (cores.empty()) {
        target += fmt::format("  {:>10}", counted + " worst");
    }
    const base::Machine* before = nullptr;
    for (const ModelledCore& core : cores) {
        const std::string modelled = short_name(*core.machine);
        text += core.machine == before ? ", then " + core.name
                                       : fmt::format("; {} cycles modelled for {}", modelled, core.name);
        before = core.machine;
        target += fmt::format("  {:>9}  {:>17}", modelled + " cycles", "band");
    }
    return text + fmt::format("\n  {:<25} {:>9} {:>9}  {:>9}  {:>9}{}  {:>8}\n", "kernel", "error max", "rounding",
                              "host ns", "cycles", target, "bytes");
}

}  // namespace

std::string to_table(const std::vector<Group>& groups, bool colour) {
    std::string text;
    bool modelled = false;
    for (const Group& group : groups) {
        std::vector<Entry> entries = group.entries;
        std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
            return a.error_max.value_or(1e300) < b.error_max.value_or(1e300);
        });
        const Cores cores = modelled_cores({&group, 1});
        modelled = modelled || !cores.empty();
        text += heading_of(group, cores);
        for (const Entry& entry : entries) {
            const bool dim = colour && (!entry.fault.empty() || (!entry.host_front && !entry.target_front));
            text += dim ? "\033[2m" + line_of(entry, cores) + "\033[0m\n" : line_of(entry, cores) + "\n";
        }
    }
    text +=
        "\n  error max, rounding: worst over the signals, relative to the largest exact sum; rounding is against the\n"
        "  exact sum of the same length. Host: per sample, window upkeep included. M7 instr.: instructions per sample "
        "on\n"
        "  the emulated core; they are not cycles. *: no kernel of the table costs less at this error (within 1 %).\n";
    if (modelled) {
        text +=
            "  M7 cycles: per sample, of the timing model, not of silicon; band: over the rule sets that fit silicon "
            "as\n"
            "  well. qemu/README.md says how far the model was from silicon.\n";
    }
    return text;
}

}  // namespace bench
