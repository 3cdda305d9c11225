#include "bench/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bench {
namespace {

std::string error(std::optional<double> value) { return value ? fmt::format("{:.2e}", *value) : "-"; }

std::string count(std::optional<double> value, const char* form) {
    return value ? fmt::format(fmt::runtime(form), *value) : "-";
}

std::string line_of(const Entry& entry) {
    const bool ranked = entry.error_max && entry.fault.empty();
    const bool dominated = ranked && !entry.host_front && !entry.target_front;
    std::string note = entry.fault;  // from a file: without what would steer a terminal
    std::replace_if(
        note.begin(), note.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    if (note.empty() && entry.software_double) {
        note = "double in software on the M7";
    }
    if (dominated) {
        note = note.empty() ? "dominated" : "dominated; " + note;
    }
    std::string line = fmt::format(
        "  {:<25} {:>9} {:>9}  {:>9}{} {:>9}  {:>10}{} {:>10}  {:>8}  {}", entry.kernel, error(entry.error_max),
        error(entry.rounding_error_max), count(entry.host_ns, "{:.1f}"), entry.host_front ? '*' : ' ',
        count(entry.host_cycles, "{:.0f}"), count(entry.target_instructions, "{:.1f}"), entry.target_front ? '*' : ' ',
        count(entry.target_worst, "{:.0f}"), count(entry.bytes, "{:.0f}"), note);
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

}  // namespace

std::string to_table(const std::vector<Group>& groups, bool colour) {
    std::string text;
    for (const Group& group : groups) {
        std::vector<Entry> entries = group.entries;
        std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
            return a.error_max.value_or(1e300) < b.error_max.value_or(1e300);
        });
        text += fmt::format("\norder {}, {} taps\n", group.order, group.taps);
        text += fmt::format("  {:<25} {:>9} {:>9}  {:>9}  {:>9}  {:>10}  {:>10}  {:>8}\n", "kernel", "error max",
                            "rounding", "host ns", "cycles", "M7 instr.", "M7 worst", "bytes");
        for (const Entry& entry : entries) {
            const bool dim = colour && (!entry.fault.empty() || (!entry.host_front && !entry.target_front));
            text += dim ? "\033[2m" + line_of(entry) + "\033[0m\n" : line_of(entry) + "\n";
        }
    }
    text +=
        "\n  error max, rounding: worst over the signals, relative to the largest exact sum; rounding is against the\n"
        "  exact sum of the same length. Host: per sample, window upkeep included. M7: instructions per sample on the\n"
        "  emulated core; they are not cycles. *: no kernel of the table costs less at this error (within 1 %).\n";
    return text;
}

}  // namespace bench
