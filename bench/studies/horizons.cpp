#include "bench/studies/horizons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/failure.hpp"
#include "base/progress.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/run/context.hpp"
#include "bench/studies/horizon_case.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/sweep/sweep.hpp"
#include "bench/target/target_rows.hpp"
#include "drive/whole_record.hpp"
#include "glsum/design/blocks.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/registry.hpp"

namespace bench {
namespace {

using WithModes = glsum::Sum<glsum::Modes, glsum::Plain, glsum::F64>;

// Of the fewest coefficients whose best layout keeps the error, within a sixty-fourth; nothing where a window is as
// short.
std::optional<std::size_t> blocks_for(const glsum::design::Tail& tail, double error) {
    std::size_t too_few = 1;
    std::size_t enough = 2;
    while (glsum::design::design_blocks(tail, enough).error > error) {
        too_few = enough;
        enough *= 2;
        if (enough > tail.horizon) {
            return std::nullopt;
        }
    }
    while (enough - too_few > std::max<std::size_t>(1, enough / 64)) {
        const std::size_t middle = (enough + too_few) / 2;
        (glsum::design::design_blocks(tail, middle).error > error ? too_few : enough) = middle;
    }
    return enough - 1;
}

// The largest error of a design on a record, against the sums of all of it.
double error_on(const HorizonCase& one, const std::vector<double>& record, const std::vector<double>& sums) {
    HostLine<WithModes> line({.order = one.order, .taps = one.modes->length(), .modes = one.modes->modes});
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
void measure_errors(std::vector<HorizonCase>& all, const std::vector<double>& orders,
                    const std::vector<std::size_t>& horizons) {
    base::Progress progress("errors", horizons.size() * std::size(signal_names) * orders.size());
    for (const std::size_t samples : horizons) {
        for (const std::string_view signal : signal_names) {
            const std::vector<double> record = make_signal(signal, samples, Sweep().seed);
            for (const double order : orders) {
                const std::vector<double> sums =
                    drive::whole_record_sums(drive::record_weights(order, samples), record);
                for (HorizonCase& one : all) {
                    if (one.order == order && one.samples == samples && one.modes) {
                        one.largest_error = std::max(one.largest_error, error_on(one, record, sums));
                    }
                }
                progress.advance();
            }
        }
    }
}

// Modelled cycles of the designs in single precision. What was measured once is known.
void measure_cycles(std::vector<HorizonCase>& all, const qemu::Board& board) {
    constexpr const char* kernel = "modes_plain_f32";
    std::map<std::pair<double, std::size_t>, std::size_t> planned;  // by order and cost: the plan's row
    std::vector<qemu::PlannedRow> plan;
    for (const HorizonCase& one : all) {
        if (one.modes && planned.emplace(std::pair(one.order, one.modes->length()), plan.size()).second) {
            plan.push_back({kernel, one.order, one.modes->length(), 0,
                            qemu::calls_to_measure(kernel, one.modes->length()), one.modes->modes});
        }
    }
    base::Progress progress(board.name(), plan.size());
    const auto measured = qemu::measure(
        board, plan, {make_signal("noise", 1000, Sweep().seed)}, [&] { progress.advance(); }, qemu::Counting::blocks,
        timing_request(board.cores, {std::string(board.machine->default_core)}));
    for (HorizonCase& one : all) {
        if (one.modes) {
            one.cycles.push_back(measured.at(planned.at({one.order, one.modes->length()})).cores.at(0).cycles);
        }
    }
}

}  // namespace

Study measure_horizons(const Horizons& wanted) {
    const auto& [horizons, orders, boards] = wanted;
    std::vector<HorizonCase> all;
    base::Progress progress("designs", orders.size() * horizons.size() * horizon_errors.size());
    for (const double order : orders) {
        const std::vector<double> weights = drive::record_weights(order, horizons.back());
        for (const double error : horizon_errors) {
            for (const std::size_t samples : horizons) {
                const std::vector<double> seen(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(samples));
                // The oldest sample that a record of N shows has the index N - 1.
                const glsum::design::Tail tail{order, samples - 1};
                all.push_back({order, error, samples, window_for(seen, error), blocks_for(tail, error),
                               design_modes(tail, error)});
                progress.advance();
            }
        }
    }
    measure_errors(all, orders, horizons);
    std::vector<HorizonCore> cores;
    std::string core_names;
    for (const qemu::Board& board : boards) {
        measure_cycles(all, board);
        cores.push_back({board.machine, std::string(board.machine->default_core)});
        core_names += (core_names.empty() ? "" : ", ") + cores.back().core;
    }
    Study study;
    study.text =
        "Multiplications a sample (a_0 = 1 needs none) for an error of the sum (|x| <= 1, before h^-v) over the whole "
        "past: of a\n"
        "window, of near taps and blocks, of near taps and modes; the modes' certificate, the largest error found in "
        "double on all\n";
    study.text +=
        fmt::format("seven signals of 0.9{}.\n",
                    boards.empty() ? "" : "; modelled cycles of the same design in single precision, " + core_names);
    for (const double order : orders) {
        study.text += to_table(order, all, cores);
    }
    for (const HorizonCase& one : all) {
        for (Json& row : to_rows(one, cores)) {
            study.wrong += row.contains("error_occurred") ? 1 : 0;
            study.rows.push_back(std::move(row));
        }
    }
    Sweep sweep;
    sweep.targets = {"host"};
    sweep.cores.clear();
    sweep.samples = horizons.back();
    sweep.orders = orders;
    sweep.signals.assign(std::begin(signal_names), std::end(signal_names));
    study.context = make_context(Json(), sweep, {});
    study.context["horizons"] = horizons;
    study.context["core"] = core_names;
    study.picture = picture_of(orders, all);
    return study;
}

}  // namespace bench
