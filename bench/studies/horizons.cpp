#include "bench/studies/horizons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/failure.hpp"
#include "base/progress.hpp"
#include "base/rounded_up.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/run/context.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/sweep/sweep.hpp"
#include "bench/target/target_rows.hpp"
#include "drive/whole_record.hpp"
#include "glsum/registry.hpp"
#include "modes/blocks.hpp"
#include "modes/design.hpp"

namespace bench {
namespace {

using glsum::modes::Approximation;
using WithModes = glsum::Sum<glsum::Modes, glsum::Plain, glsum::F64>;

constexpr double errors[] = {1e-2, 1e-4, 1e-6};  // of the sum, for |x| <= 1, before h^-v

// What an error over a horizon takes.
struct Cost {
    double order;
    double error;
    std::size_t samples;
    std::optional<std::size_t> window;  // multiplications; nothing: as many as samples, but one
    std::optional<std::size_t> blocks;  // multiplications
    std::optional<Approximation> modes;
    double largest_error = 0.0;  // of the modes' kernel over the whole record, found
    double promised = 0.0;       // the most that it may be
    std::optional<double> cycles = {};
};

// Multiplications, counted as the kernels do (a_0 = 1 needs none), of the fewest taps that leave less than the error of
// the weights up to the horizon.
std::optional<std::size_t> window_for(const std::vector<double>& weights, double error) {
    double left = 0.0;
    std::size_t taps = weights.size();
    while (taps > 1 && left + std::fabs(weights[taps - 1]) <= error) {
        left += std::fabs(weights[--taps]);
    }
    return taps < weights.size() ? std::optional(taps - 1) : std::nullopt;
}

// Of the fewest coefficients whose best layout keeps the error, within a sixty-fourth; nothing where a window is as
// short.
std::optional<std::size_t> blocks_for(const glsum::modes::Tail& tail, double error) {
    std::size_t too_few = 1;
    std::size_t enough = 2;
    while (glsum::modes::design_blocks(tail, enough).error > error) {
        too_few = enough;
        enough *= 2;
        if (enough > tail.horizon) {
            return std::nullopt;
        }
    }
    while (enough - too_few > std::max<std::size_t>(1, enough / 64)) {
        const std::size_t middle = (enough + too_few) / 2;
        (glsum::modes::design_blocks(tail, middle).error > error ? too_few : enough) = middle;
    }
    return enough - 1;
}

// The largest error of a design on a record, against the sums of all of it.
double error_on(const Cost& cost, const std::vector<double>& record, const std::vector<double>& sums) {
    HostLine<WithModes> line({.order = cost.order, .taps = cost.modes->length(), .modes = cost.modes->modes});
    if (line.status() != glsum::Status::ok) {
        throw glsum::Failure(glsum::Exit::check_failed, to_text(line.status()));
    }
    double largest = 0.0;
    for (std::size_t k = 0; k < record.size(); ++k) {
        largest = std::max(largest, std::fabs(line.step(record[k]) - sums[k]));
    }
    return largest;
}

// Every design on every signal. A record is made once, and its sums once for each order.
void measure_errors(std::vector<Cost>& all, const std::vector<double>& orders,
                    const std::vector<std::size_t>& horizons) {
    base::Progress progress("errors", horizons.size() * std::size(signal_names) * orders.size());
    for (const std::size_t samples : horizons) {
        for (const std::string_view signal : signal_names) {
            const std::vector<double> record = make_signal(signal, samples, Sweep().seed);
            for (const double order : orders) {
                const std::vector<double> sums =
                    drive::whole_record_sums(drive::record_weights(order, samples), record);
                for (Cost& cost : all) {
                    if (cost.order == order && cost.samples == samples && cost.modes) {
                        cost.largest_error = std::max(cost.largest_error, error_on(cost, record, sums));
                    }
                }
                progress.advance();
            }
        }
    }
}

Row to_row(const Cost& cost, std::string_view kernel, std::size_t macs) {
    RowKey key;
    key.kind = RowKind::horizon;
    key.kernel = kernel;
    key.order = fmt::format("{}", cost.order);
    key.error = fmt::format("{:g}", cost.error);
    key.samples = std::to_string(cost.samples);
    Row row(key, cost.samples);
    row.set(Counter::horizon_samples, cost.samples);
    row.set(Counter::macs_per_sample, macs);
    return row;
}

std::string to_table(double order, const std::vector<Cost>& costs) {
    std::string text =
        fmt::format("\nOrder {}\n  {:>8} {:>10}  {:>10} {:>10} {:>16} {:>12} {:>12} {:>8}\n", order, "error", "samples",
                    "window", "blocks", "modes", "certificate", "error found", "cycles");
    for (const Cost& cost : costs) {
        const auto number = [](const std::optional<std::size_t>& value) {
            return value ? fmt::format("{}", *value) : "all";
        };
        text += fmt::format("  {:>8g} {:>10}  {:>10} {:>10} {:>16} {:>12} {:>12} {:>8}{}\n", cost.error, cost.samples,
                            number(cost.window), number(cost.blocks),
                            cost.modes ? fmt::format("{} ({}+{})", cost.modes->multiplications(), cost.modes->near_taps,
                                                     cost.modes->modes.size())
                                       : "-",
                            cost.modes ? base::rounded_up(cost.modes->error, 2) : "-",
                            cost.modes ? fmt::format("{:.1e}", cost.largest_error) : "-",
                            cost.cycles ? fmt::format("{:.0f}", *cost.cycles) : "-",
                            cost.largest_error > cost.promised ? "  WRONG" : "");
    }
    return text;
}

// Multiplications over the horizon: a panel for each order and error.
base::Picture picture_of(const std::vector<double>& orders, const std::vector<Cost>& all) {
    const std::size_t width = 280 + 260 * orders.size();
    const std::size_t height = 110 + 230 * std::size(errors);
    const auto wide = static_cast<double>(width);
    const auto tall = static_cast<double>(height);
    const auto shortest = static_cast<double>(all.front().samples);
    const auto longest = static_cast<double>(all.back().samples);
    std::string script = fmt::format(
        "set multiplot layout {},{} margins {:.4f},{:.4f},{:.4f},{:.4f} spacing {:.4f},{:.4f} title \"Multiplications "
        "a "
        "sample for an error of the sum, over the samples that the past may hold\"\n"
        "set logscale xy\nset format \"10^{{%L}}\"\nset xtics nomirror\nset ytics nomirror\nset mxtics 1\nset mytics "
        "1\n"
        "set grid lc rgb \"#dddddd\"\nset xrange [{}:{}]\nset yrange [3:{}]\n",
        std::size(errors), orders.size(), 65.0 / wide, 1.0 - 235.0 / wide, 60.0 / tall, 1.0 - 70.0 / tall, 50.0 / wide,
        60.0 / tall, shortest / 2.0, longest * 2.0, longest * 2.0);
    const auto data_of = [&](std::size_t way, double order, double error) {
        std::string data;
        for (const Cost& cost : all) {
            if (cost.order != order || cost.error != error) {
                continue;
            }
            std::optional<std::size_t> macs = cost.window.value_or(cost.samples - 1);
            if (way == 1) {
                macs = cost.blocks;
            } else if (way == 2) {
                macs = cost.modes ? std::optional(cost.modes->multiplications()) : std::nullopt;
            }
            data += macs ? fmt::format("{} {}\n", cost.samples, *macs) : "";
        }
        return data.empty() ? std::string("1000 NaN\n") : data;
    };
    constexpr std::string_view titles[] = {"window", "near taps and blocks", "near taps and modes"};
    std::string key = fmt::format("set key at screen {:.4f}, screen {:.4f} left top Left reverse spacing 1.4",
                                  1.0 - 222.0 / wide, 1.0 - 70.0 / tall);
    for (const double error : errors) {
        for (const double order : orders) {
            std::vector<std::string> lines;
            for (std::size_t way = 0; way < std::size(titles); ++way) {
                script += fmt::format("$d{} << EOD\n{}EOD\n", way, data_of(way, order, error));
                lines.push_back(
                    fmt::format("$d{} using 1:2 with linespoints lw 1.8 pt {} ps 0.8 lc rgb \"{}\" title \"{}\"", way,
                                5 + 2 * way, base::palette[way], titles[way]));
            }
            script += fmt::format(
                "set title \"order {}, error 10^{{{:.0f}}}\" offset 0,-0.6\nset xlabel \"{}\" offset 0,0.4\n{}\nplot "
                "{}\n",
                order, std::log10(error), error == errors[std::size(errors) - 1] ? "samples" : "", key,
                fmt::join(lines, ", \\\n  "));
            key = "unset key";
        }
    }
    return {script + "unset multiplot\n", width, height};
}

// Modelled cycles of the designs in single precision. What was measured once is known.
void measure_cycles(std::vector<Cost>& all, const qemu::Board& board, const std::string& core) {
    constexpr const char* kernel = "modes_plain_f32";
    std::map<std::pair<double, std::size_t>, std::size_t> planned;  // by order and cost: the plan's row
    std::vector<qemu::PlannedRow> plan;
    for (const Cost& cost : all) {
        if (cost.modes && planned.emplace(std::pair(cost.order, cost.modes->length()), plan.size()).second) {
            plan.push_back({kernel, cost.order, cost.modes->length(), 0,
                            qemu::calls_to_measure(kernel, cost.modes->length()), cost.modes->modes});
        }
    }
    base::Progress progress("emulated Cortex-M7", plan.size());
    const auto measured = qemu::measure(
        board, plan, {make_signal("noise", 1000, Sweep().seed)}, [&] { progress.advance(); }, qemu::Counting::blocks,
        timing_request(board.cores, {core}));
    for (Cost& cost : all) {
        if (cost.modes) {
            cost.cycles = measured.at(planned.at({cost.order, cost.modes->length()})).cores.at(0).cycles;
        }
    }
}

}  // namespace

Study measure_horizons(const Horizons& wanted) {
    const auto& [horizons, orders, board, core] = wanted;
    std::vector<Cost> all;
    base::Progress progress("designs", orders.size() * horizons.size() * std::size(errors));
    for (const double order : orders) {
        const std::vector<double> weights = drive::record_weights(order, horizons.back() + 1);
        for (const double error : errors) {
            for (const std::size_t samples : horizons) {
                const std::vector<double> seen(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(samples));
                // The oldest sample that a record of N shows has the index N - 1.
                const glsum::modes::Tail tail{order, samples - 1};
                Cost cost{order, error, samples, window_for(seen, error), blocks_for(tail, error), design(tail, error)};
                // The design's certificate, and the rounding of both sides in double.
                cost.promised = cost.modes ? signal_peak * (cost.modes->error + 1e-11) : 0.0;
                all.push_back(std::move(cost));
                progress.advance();
            }
        }
    }
    measure_errors(all, orders, horizons);
    if (board) {
        measure_cycles(all, *board, core);
    }
    Study study;
    study.text =
        "Multiplications a sample (a_0 = 1 needs none) for an error of the sum (|x| <= 1, before h^-v) over the whole "
        "past: of a\n"
        "window, of near taps and blocks, of near taps and modes; the modes' certificate, the largest error found in "
        "double on all\n";
    study.text += fmt::format("seven signals of 0.9{}.\n",
                              !board ? "" : "; modelled cycles of the same design in single precision, " + core);
    for (const double order : orders) {
        std::vector<Cost> of_order;
        std::copy_if(all.begin(), all.end(), std::back_inserter(of_order),
                     [&](const Cost& cost) { return cost.order == order; });
        study.text += to_table(order, of_order);
    }
    for (const Cost& cost : all) {
        study.rows.push_back(to_row(cost, "window", cost.window.value_or(cost.samples - 1)).take());
        if (cost.blocks) {
            study.rows.push_back(to_row(cost, "nested", *cost.blocks).take());
        }
        if (cost.modes) {
            Row row = to_row(cost, "modes", cost.modes->multiplications());
            row.set(Counter::near_taps, cost.modes->near_taps);
            row.set(Counter::modes, cost.modes->modes.size());
            row.set(Counter::design_error, cost.modes->error);
            row.set(Counter::absolute_error_max, cost.largest_error);
            if (cost.cycles) {
                row.set(Counter::model_cycles_per_sample, *cost.cycles);
            }
            if (cost.largest_error > cost.promised) {
                row.mark_error(fmt::format("errs by {:.3g}, promised {:.3g}", cost.largest_error, cost.promised));
                ++study.wrong;
            }
            study.rows.push_back(std::move(row).take());
        }
    }
    Sweep sweep;
    sweep.targets = {"host"};
    sweep.cores.clear();
    sweep.samples = horizons.back();
    sweep.orders = orders;
    sweep.signals.assign(std::begin(signal_names), std::end(signal_names));
    study.context = make_context(Json(), sweep, nullptr);
    study.context["horizons"] = horizons;
    study.context["core"] = core;
    study.picture = picture_of(orders, all);
    return study;
}

}  // namespace bench
