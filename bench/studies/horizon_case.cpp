#include "bench/studies/horizon_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/rounded_up.hpp"
#include "bench/rows/key.hpp"
#include "bench/sweep/signals.hpp"

namespace bench {
namespace {

constexpr double rounding = 1e-11;  // of a design's sums and of the exact ones, in double over 10^7 samples

Row row_of(const HorizonCase& one, std::string_view kernel, std::size_t macs, const std::string& aspect = "") {
    RowKey key;
    key.kind = RowKind::horizon;
    key.kernel = kernel;
    key.order = fmt::format("{}", one.order);
    key.error = fmt::format("{:g}", one.error);
    key.samples = std::to_string(one.samples);
    key.aspect = aspect;
    Row row(key, one.samples);
    row.set(Counter::horizon_samples, one.samples);
    row.set(Counter::macs_per_sample, macs);
    return row;
}

}  // namespace

double HorizonCase::promised() const { return modes ? signal_peak * (modes->error + rounding) : 0.0; }

std::optional<std::size_t> window_for(const std::vector<double>& weights, double error) {
    double left = 0.0;
    std::size_t taps = weights.size();
    while (taps > 1 && left + std::fabs(weights[taps - 1]) <= error) {
        left += std::fabs(weights[--taps]);
    }
    return taps < weights.size() ? std::optional(taps - 1) : std::nullopt;
}

std::vector<Json> to_rows(const HorizonCase& one, const std::vector<HorizonCore>& cores) {
    std::vector<Json> rows{row_of(one, "window", one.window_macs()).take()};
    if (one.blocks) {
        rows.push_back(row_of(one, "nested", *one.blocks).take());
    }
    if (one.modes) {
        Row row = row_of(one, "modes", one.modes->multiplications());
        row.set(Counter::near_taps, one.modes->near_taps);
        row.set(Counter::modes, one.modes->modes.size());
        row.set(Counter::design_error, one.modes->error);
        row.set(Counter::absolute_error_max, one.largest_error);
        if (!one.cycles.empty()) {
            row.set(Counter::model_cycles_per_sample, one.cycles.front());
        }
        if (one.largest_error > one.promised()) {
            row.mark_error(fmt::format("errs by {:.3g}, promised {:.3g}", one.largest_error, one.promised()));
        }
        rows.push_back(std::move(row).take());
        for (std::size_t i = 1; i < one.cycles.size(); ++i) {
            Row on_core =
                row_of(one, "modes", one.modes->multiplications(), on_target(*cores.at(i).machine, cores.at(i).core));
            on_core.set(Counter::model_cycles_per_sample, one.cycles[i]);
            rows.push_back(std::move(on_core).take());
        }
    }
    return rows;
}

std::string to_table(double order, const std::vector<HorizonCase>& cases, const std::vector<HorizonCore>& cores) {
    std::string text = fmt::format("\nOrder {}\n  {:>8} {:>10}  {:>10} {:>10} {:>16} {:>12} {:>12}", order, "error",
                                   "samples", "window", "blocks", "modes", "certificate", "error found");
    const std::size_t columns = std::max<std::size_t>(cores.size(), 1);
    for (std::size_t i = 0; i < columns; ++i) {
        text += columns == 1 ? fmt::format(" {:>8}", "cycles")
                             : fmt::format(" {:>10}", std::string(cores[i].machine->word) + " cycles");
    }
    text += "\n";
    for (const HorizonCase& one : cases) {
        if (one.order != order) {
            continue;
        }
        const auto number = [](const std::optional<std::size_t>& value) {
            return value ? fmt::format("{}", *value) : "all";
        };
        text += fmt::format("  {:>8g} {:>10}  {:>10} {:>10} {:>16} {:>12} {:>12}", one.error, one.samples,
                            number(one.window), number(one.blocks),
                            one.modes ? fmt::format("{} ({}+{})", one.modes->multiplications(), one.modes->near_taps,
                                                    one.modes->modes.size())
                                      : "-",
                            one.modes ? base::rounded_up(one.modes->error, 2) : "-",
                            one.modes ? fmt::format("{:.1e}", one.largest_error) : "-");
        for (std::size_t i = 0; i < columns; ++i) {
            text += fmt::format(" {:>{}}", i < one.cycles.size() ? fmt::format("{:.0f}", one.cycles[i]) : "-",
                                columns == 1 ? 8 : 10);
        }
        text += one.largest_error > one.promised() ? "  WRONG\n" : "\n";
    }
    return text;
}

}  // namespace bench
