#include "bench/equal_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "bench/accuracy.hpp"
#include "bench/host_line.hpp"
#include "bench/oustaloup.hpp"
#include "bench/signals.hpp"
#include "bench/sweep.hpp"
#include "glsum/registry.hpp"

namespace bench {
namespace {

using FullMemory = glsum::Sum<glsum::Mirror, glsum::Multi, glsum::F64>;

// Usual ones, a decade of frequency beyond the signals' on either side.
constexpr Band bands[] = {{0.1, 2000.0}, {0.01, 1000.0}, {0.1, 20000.0}};

// Two near taps where that leaves whole modes, else one.
Length with_modes(std::size_t cost) {
    const std::size_t near_taps = cost % 2 == 0 ? 2 : 1;
    return {cost, false, (cost - near_taps) / 2};
}

struct Errors {
    double largest = 0.0;
    double late = 0.0;
};

Errors errors_of(Oustaloup filter, const std::vector<double>& record, const std::vector<double>& sums, double peak) {
    Errors errors;
    for (std::size_t k = 0; k < record.size(); ++k) {
        const double error = std::fabs(filter.step(record[k]) - sums[k]) / peak;
        const double counted = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
        errors.largest = std::max(errors.largest, counted);
        errors.late = 2 * k >= record.size() ? std::max(errors.late, counted) : errors.late;
    }
    return errors;
}

std::vector<Json> oustaloup_rows(const EqualCost& wanted, double order, const std::string& signal) {
    if (!(order > -1.0 && order < 2.0) || order == std::floor(order)) {
        return {};
    }
    const std::vector<double> record = make_signal(signal, wanted.samples, Sweep().seed);
    // In double, 1e-13 from the exact sum: nothing beside what is compared.
    HostLine<FullMemory> line(glsum::Design{order, wanted.samples});
    std::vector<double> sums;
    double peak = 0.0;
    for (const double sample : record) {
        sums.push_back(line.step(sample));
        peak = std::max(peak, std::fabs(sums.back()));
    }
    std::vector<Json> rows;
    for (const std::size_t cost : wanted.costs) {
        const std::size_t poles = (cost - 1) / 2;
        std::optional<Errors> best;
        Json row;
        for (const Band& band : bands) {
            for (const Mapping mapping : {Mapping::matched, Mapping::tustin}) {
                const Errors errors = errors_of(Oustaloup(order, step_s, poles, band, mapping), record, sums, peak);
                if (best && errors.largest >= best->largest) {
                    continue;
                }
                best = errors;
                row = make_row(
                    fmt::format("filter/oustaloup_f64/order:{}/poles:{}/accuracy/signal:{}", order, poles, signal),
                    record.size());
                row["error_max"] = errors.largest;
                row["error_late_max"] = errors.late;
                row["macs_per_sample"] = Oustaloup(order, step_s, poles, band, mapping).multiplications();
                row["mapping"] = to_text(mapping);
                row["low_rad_s"] = band.low_rad_s;
                row["high_rad_s"] = band.high_rad_s;
            }
        }
        row["cost"] = cost;
        row["way"] = "oustaloup_f64";
        rows.push_back(row);
    }
    return rows;
}

// Of a kernel's rows the one with the most multiplications that the cost allows.
const Json* dearest_within(const std::vector<Json>& rows, std::string_view kernel, std::size_t cost) {
    const auto macs = [](const Json& row) { return row.at("macs_per_sample").get<std::size_t>(); };
    const std::string begin = fmt::format("gl/{}/", kernel);
    const Json* found = nullptr;
    for (const Json& row : rows) {
        if (row.at("name").get<std::string>().starts_with(begin) && row.contains("macs_per_sample") &&
            macs(row) <= cost && (found == nullptr || macs(row) > macs(*found))) {
            found = &row;
        }
    }
    return found;
}

}  // namespace

std::vector<Json> measure_equal_cost(const EqualCost& wanted) {
    Sweep sweep;
    sweep.orders = wanted.orders;
    sweep.signals = wanted.signals;
    sweep.samples = wanted.samples;
    sweep.jobs = wanted.jobs;
    glsum::Registry::for_each([&]<class K>() {
        if (std::ranges::any_of(equal_cost_ways(), [](const EqualCostWay& way) { return way.kernel == K::name(); })) {
            sweep.kernels.emplace_back(K::name());
        }
    });
    // Windows that guess a tail pay for that too, and are as much shorter.
    std::set<std::size_t> windows;
    for (const std::size_t cost : wanted.costs) {
        windows.insert({cost - 2, cost - 1, cost});
    }
    for (const std::size_t taps : windows) {
        sweep.lengths.push_back({taps});
        if (std::ranges::find(wanted.costs, taps) != wanted.costs.end()) {
            sweep.lengths.push_back(with_modes(taps));
        }
    }
    std::vector<std::size_t> cases(wanted.orders.size() * wanted.signals.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        cases[i] = i;
    }
    const std::vector<std::vector<Json>> measured = measure_accuracy(sweep, cases);
    std::vector<Json> rows;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        for (const EqualCostWay& way : equal_cost_ways()) {
            for (const std::size_t cost : wanted.costs) {
                if (const Json* row = dearest_within(measured[i], way.kernel, cost)) {
                    rows.push_back(*row);
                    rows.back()["cost"] = cost;
                    rows.back()["way"] = way.kernel;
                }
            }
        }
        for (Json& row : oustaloup_rows(wanted, wanted.orders[i / wanted.signals.size()],
                                        wanted.signals[i % wanted.signals.size()])) {
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

}  // namespace bench
