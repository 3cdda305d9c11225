#include "qemu/emulate/rows_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "qemu/emulate/silicon.hpp"

namespace qemu {
namespace {

RowFit fit_row(const MeasuredCall& row, const PredictedCall& predicted) {
    const double outside = std::max({0.0, predicted.low - row.cycles, row.cycles - predicted.high});
    return {predicted.cycles / row.cycles - 1.0, (predicted.high - predicted.low) / 2.0 / predicted.cycles,
            outside <= 0.0, misses(predicted.cycles * row.per, row.cycles * row.per),
            (predicted.high - predicted.low + 2.0 / (1.0 - band_coverage) * outside) / row.cycles};
}

std::vector<RowLine> lines_of(const std::vector<MeasuredCall>& rows, const std::vector<PredictedCall>& predicted) {
    struct Calls {
        std::vector<double> instructions;
        std::vector<double> measured;
        std::vector<double> predicted;
    };
    std::map<std::tuple<std::string, std::string, std::string, std::string>, Calls> groups;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const MeasuredCall& row = rows[i];
        Calls& calls = groups[{row.function, row.core, row.code, row.data}];
        calls.instructions.push_back(predicted[i].instructions * row.per);
        calls.measured.push_back(row.cycles * row.per);
        calls.predicted.push_back(predicted[i].cycles * row.per);
    }
    std::vector<RowLine> lines;
    for (const auto& [key, calls] : groups) {
        const auto [shortest, longest] = std::minmax_element(calls.instructions.begin(), calls.instructions.end());
        if (*longest >= longer_call * *shortest) {
            const auto& [function, core, code, data] = key;
            const FittedLine measured = fit_line(calls.instructions, calls.measured);
            const FittedLine model = fit_line(calls.instructions, calls.predicted);
            lines.push_back({function, core, code, data, calls.measured.size(), measured.slope, model.slope,
                             measured.constant, model.constant});
        }
    }
    return lines;
}

// The least half-width that holds so many of these: the split-conformal quantile, which counts the row to come.
double holding(std::vector<double> distances) {
    std::sort(distances.begin(), distances.end());
    const auto nth = static_cast<std::size_t>(std::ceil(band_coverage * static_cast<double>(distances.size() + 1)));
    return distances[std::min(nth, distances.size()) - 1];
}

std::vector<GroupLeftOut> leave_out(const std::vector<MeasuredCall>& rows,
                                    const std::vector<PredictedCall>& predicted) {
    std::map<std::string, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        groups[rows[i].group].push_back(i);
    }
    if (groups.size() < 2) {
        return {};
    }
    const auto distance = [&](std::size_t i) { return std::abs(rows[i].cycles / predicted[i].cycles - 1.0); };
    std::vector<GroupLeftOut> found;
    for (const auto& [name, members] : groups) {
        std::vector<double> others;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (rows[i].group != name) {
                others.push_back(distance(i));
            }
        }
        GroupLeftOut left_out{name, members.size(), holding(others), 0.0, 0.0};
        const auto share = 1.0 / static_cast<double>(members.size());
        for (const std::size_t i : members) {
            PredictedCall even = predicted[i];
            even.low = even.cycles * (1.0 - left_out.half_width);
            even.high = even.cycles * (1.0 + left_out.half_width);
            const RowFit fit = fit_row(rows[i], even);
            left_out.inside += fit.inside ? share : 0.0;
            left_out.interval_score += share * fit.interval_score;
        }
        found.push_back(left_out);
    }
    return found;
}

}  // namespace

bool misses(double predicted, double measured) {
    return std::abs(predicted / measured - 1.0) > allowed_share && std::abs(predicted - measured) > allowed_cycles;
}

double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2.0;
}

RowsFit fit_of(const std::vector<MeasuredCall>& rows, const std::vector<PredictedCall>& predicted) {
    RowsFit fit{};
    std::vector<double> errors;
    std::vector<double> half_widths;
    const auto share = 1.0 / static_cast<double>(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const RowFit row = fit_row(rows[i], predicted[i]);
        errors.push_back(std::abs(row.error));
        half_widths.push_back(row.half_width);
        fit.inside += row.inside ? share : 0.0;
        fit.missed += row.missed ? 1 : 0;
        fit.mean_interval_score += share * row.interval_score;
        fit.rows.push_back(row);
    }
    fit.worst.resize(rows.size());
    std::iota(fit.worst.begin(), fit.worst.end(), std::size_t{0});
    std::stable_sort(fit.worst.begin(), fit.worst.end(),
                     [&](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
    fit.worst_error = fit.rows[fit.worst.front()].error;
    fit.median_error = median_of(errors);
    fit.median_half_width = median_of(half_widths);
    fit.lines = lines_of(rows, predicted);
    fit.left_out = leave_out(rows, predicted);
    return fit;
}

}  // namespace qemu
