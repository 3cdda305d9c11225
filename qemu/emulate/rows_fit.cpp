#include "qemu/emulate/rows_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

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

// The least scale that holds so many of these: the split-conformal quantile, which counts the row to come.
double holding(std::vector<double> distances) {
    std::sort(distances.begin(), distances.end());
    const auto nth = static_cast<std::size_t>(std::ceil(band_coverage * static_cast<double>(distances.size() + 1)));
    return distances[std::min(nth, distances.size()) - 1];
}

// How far off the measured cycles are, in widths of the band to their side. The band is the model's opinion of how sure
// it is of each figure, so that rows of all kinds are compared.
double distance(const MeasuredCall& row, const PredictedCall& predicted) {
    constexpr double narrowest = 1e-6;  // of a core without a band
    const double off = row.cycles - predicted.cycles;
    const double side = off > 0.0 ? predicted.high - predicted.cycles : predicted.cycles - predicted.low;
    return std::abs(off) / std::max(side, narrowest * predicted.cycles);
}

BandFit band_fit(const std::vector<MeasuredCall>& rows, const std::vector<PredictedCall>& predicted,
                 const std::vector<std::size_t>& members, double scale) {
    BandFit band{0.0, 0.0, 0.0};
    std::vector<double> half_widths;
    const auto share = 1.0 / static_cast<double>(members.size());
    for (const std::size_t i : members) {
        PredictedCall scaled = predicted[i];
        scaled.low = scaled.cycles - scale * (scaled.cycles - scaled.low);
        scaled.high = scaled.cycles + scale * (scaled.high - scaled.cycles);
        const RowFit fit = fit_row(rows[i], scaled);
        half_widths.push_back(fit.half_width);
        band.inside += fit.inside ? share : 0.0;
        band.interval_score += share * fit.interval_score;
    }
    band.half_width = median_of(half_widths);
    return band;
}

std::vector<GroupLeftOut> leave_out(const std::vector<MeasuredCall>& rows,
                                    const std::vector<PredictedCall>& predicted) {
    std::map<std::pair<bool, std::string>, std::vector<std::size_t>> groups;
    std::map<std::string, std::set<std::string>> of_author;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        groups[{false, rows[i].group}].push_back(i);
        if (const auto slash = rows[i].group.find('/'); slash != std::string::npos) {
            groups[{true, rows[i].group.substr(0, slash)}].push_back(i);
            of_author[rows[i].group.substr(0, slash)].insert(rows[i].group);
        }
    }
    std::vector<GroupLeftOut> found;
    for (const auto& [name, members] : groups) {
        if (members.size() == rows.size() || (name.first && of_author[name.second].size() < 2)) {
            continue;
        }
        std::vector<double> others;
        for (std::size_t i = 0, next = 0; i < rows.size(); ++i) {
            if (next < members.size() && members[next] == i) {
                ++next;
            } else {
                others.push_back(distance(rows[i], predicted[i]));
            }
        }
        const double scale = holding(std::move(others));
        found.push_back({name.second, name.first, members.size(), band_fit(rows, predicted, members, 1.0), scale,
                         band_fit(rows, predicted, members, scale)});
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
