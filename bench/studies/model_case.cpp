#include "bench/studies/model_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "bench/rows/result_file.hpp"

namespace bench {

std::string in_thousands(double cycles) {
    const auto whole = static_cast<std::int64_t>(std::llround(cycles));
    return whole < 1000 ? std::to_string(whole) : fmt::format("{} {:03}", whole / 1000, whole % 1000);
}

namespace {

Row row_of(const ModelCase& one, const std::string& aspect) {
    RowKey key;
    key.kind = RowKind::model;
    key.model = one.model;
    key.kernel = one.name;
    key.taps = one.length();
    key.aspect = aspect;
    Row row(key, one.steps + 1);
    row.set(Counter::error_max, one.error_max);
    row.set(Counter::error_rms, one.error_rms);
    row.set(Counter::final_output, one.final_output);
    if (one.design.memory().modes == 0) {
        row.set(Counter::effective_taps, one.design.memory().taps);
    }
    row.set(Counter::macs_per_sample, one.macs);
    row.set(Counter::horizon_samples, one.design.memory().modes == 0 ? one.design.memory().taps : one.steps);
    if (!one.fault.empty()) {
        row.mark_error(one.fault);
    } else if (facts_of(one.kernel).exact_sums) {  // fixed point
        row.set(Counter::saturations, one.saturations);
    }
    return row;
}

// Instructions, cycles with their band, and the worst step's share of the period; dashes where nothing was counted.
std::string to_cells(const qemu::MeasuredRow* counted, double period) {
    if (counted == nullptr) {
        return fmt::format("{:>10} {:>17} {:>8} ", "-", "-", "-");
    }
    const auto worst = static_cast<double>(counted->worst_instructions);
    const auto& cores = counted->cores;
    return fmt::format("{:>10.1f} {:>17} {:>7.2f}% ", counted->instructions,
                       cores.empty() ? "-"
                       : cores[0].low == cores[0].high
                           ? fmt::format("{:.0f}", cores[0].cycles)
                           : fmt::format("{:.0f} ({:.0f}-{:.0f})", cores[0].cycles, cores[0].low, cores[0].high),
                       100.0 * (cores.empty() ? worst : cores[0].worst_cycles) / period);
}

}  // namespace

Json to_host_row(const ModelCase& one) {
    Row row = row_of(one, std::string(RowKey::host));
    if (one.fault.empty()) {
        row.set_time(one.host_ns);
        row.set(Counter::ns_per_sample, one.host_ns);
    }
    return std::move(row).take();
}

Json to_target_row(const ModelCase& one, const Counted& counted, const std::string& aspect,
                   std::optional<std::size_t> core, double clock_hz, double period) {
    Row row = row_of(one, aspect);
    row.set_text("label", label_of(core.has_value(), "", one.in_double()));
    add_instructions(row, counted.row);
    row.set(Counter::instructions_share_of_period, static_cast<double>(counted.row.worst_instructions) / period);
    if (core) {
        const qemu::ModelledCall& modelled = counted.row.cores.at(*core);
        add_modelled(row, modelled, clock_hz);
        row.set(Counter::share_of_period, modelled.worst_cycles / (clock_hz * model_step_s));
    }
    add_bytes(row, counted.row);
    if (core) {
        mark_unknown_encodings(row, counted.row);
    }
    if (!counted.same_bits) {
        row.mark_error(other_bits);
    }
    return std::move(row).take();
}

std::string to_table(const std::vector<ModelCase>& cases, const std::string& model,
                     const std::vector<ModelColumns>& machines) {
    std::string text = fmt::format("\n{}\n  {:<28} {:>6} {:>5} {:>5} {:>10} {:>10} ", model, "kernel", "taps", "MACs",
                                   "for s", "error max", "at the end");
    for (const ModelColumns& on : machines) {
        text += fmt::format("{:>10} {:>17} {:>8} ", on.machine + " instr.", "model cycles", "period");
    }
    text += fmt::format("{:>8}  {}\n", "bytes", "host ns");
    for (const ModelCase& one : cases) {
        if (one.model != model) {
            continue;
        }
        text += fmt::format("  {:<28} {:>6} ", one.name, one.length());
        if (!one.fault.empty()) {
            text += one.fault + "\n";
            continue;
        }
        text += fmt::format("{:>5} {:>5.0f} {:>10.2e} {:>10.5f} ", one.macs,
                            static_cast<double>(one.steps) * model_step_s, one.error_max, one.final_output);
        for (std::size_t i = 0; i < machines.size(); ++i) {
            text += to_cells(one.counted.empty() ? nullptr : &one.counted[i].row, machines[i].period);
        }
        text += one.counted.empty()
                    ? fmt::format("{:>8}  ", "-")
                    : fmt::format("{:>8}  ", one.counted[0].row.state_bytes + one.counted[0].row.coefficient_bytes);
        text += fmt::format("{:.1f}{}{}\n", one.host_ns,
                            one.saturations > 0 ? fmt::format("  {} saturations", one.saturations) : "",
                            one.same_bits() ? "" : "  NOT THE HOST'S BITS");
    }
    return text;
}

std::string deadline_table(const std::vector<ModelCase>& cases, std::size_t machine, const ModelColumns& columns) {
    const double period = columns.period;
    std::string text = fmt::format(
        "\nThe longest memory at 1 kHz on an {}, {} cycles a step, by the line through two counted lengths\n  {:<10} "
        "{:<28} "
        "{:>16} {:>14} {:>16} {:>16}\n",
        columns.machine, in_thousands(period), "model", "kernel", "instr. a tap", "bytes a tap", "1 a cycle",
        "in 320 KB");
    std::map<std::pair<std::string, std::string>, std::vector<const ModelCase*>> counted;
    for (const ModelCase& one : cases) {
        if (!one.counted.empty() && one.fault.empty() && one.design.memory().modes == 0) {
            counted[{one.model, one.name}].push_back(&one);
        }
    }
    for (const auto& [key, list] : counted) {
        const auto [shortest, longest] = std::minmax_element(
            list.begin(), list.end(),
            [](const ModelCase* a, const ModelCase* b) { return a->design.memory().taps < b->design.memory().taps; });
        const auto taps = [](const ModelCase* one) { return static_cast<double>(one->design.memory().taps); };
        const auto cost = [machine](const ModelCase* one) {
            return static_cast<double>(one->counted.at(machine).row.worst_instructions);
        };
        const auto bytes = [machine](const ModelCase* one) {
            const qemu::MeasuredRow& row = one->counted.at(machine).row;
            return static_cast<double>(row.state_bytes + row.coefficient_bytes);
        };
        if (taps(*longest) < taps(*shortest) + 32.0) {
            continue;  // whole orders: the memory ends by itself
        }
        const double span = taps(*longest) - taps(*shortest);
        text += fmt::format(
            "  {:<10} {:<28} {:>16.2f} {:>14.1f} {:>16} {:>16}\n", key.first, key.second,
            (cost(*longest) - cost(*shortest)) / span, (bytes(*longest) - bytes(*shortest)) / span,
            drive::largest_taps(taps(*shortest), cost(*shortest), taps(*longest), cost(*longest), period),
            drive::largest_taps(taps(*shortest), bytes(*shortest), taps(*longest), bytes(*longest), 320.0 * 1024.0));
    }
    return text +
           "  Instructions are not cycles: waits make the length shorter, a second instruction in a cycle longer.\n";
}

}  // namespace bench
