#include "bench/studies/bands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "bench/choose/derivative_errors.hpp"
#include "bench/choose/kernel_run.hpp"
#include "bench/rows/key.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/sweep.hpp"
#include "glsum/design/rational.hpp"

namespace bench {
namespace {

namespace design = glsum::design;

// Single precision with modes: what is cheapest on the core. Of windows so short that they cost as little nothing lasts
// over a decade.
constexpr const char* kernels[] = {"modes_plain_f32", "modesdelta_plain_f32", "modessum_plain_f32", "cascade_df2t_f32",
                                   "cascadedelta_df2t_f32"};

struct Case {
    double order;
    design::Band band;
};

bool is_ours(const BandPoint& point) { return rival_of(point.way) == nullptr; }

// The kernel that a filter of others stands in, with P poles behind one tap.
const char* kernel_of(const Rival& rival, double order) {
    const bool increments = order > 1.0;
    return rival.cascade ? kernels[increments ? 4 : 3] : kernels[increments ? 1 : 0];
}

BandPoint point_of(const Case& of, const std::string& way, std::size_t near_taps, std::size_t modes, double error) {
    return {way, fmt::format("{}+{}", near_taps, modes), of.order, of.band, error, 0.0, 0.0, 0.0};
}

// A point and the kernel and length whose cost it has.
struct Asked {
    BandPoint point;
    choose::Case cost;
};

// As ours: what the kernel holds of it, certified, with the noise of its arithmetic. Empty of a cascade that cannot.
std::optional<double> error_of_rational(const Rival& rival, const design::DerivativeGoal& goal, std::size_t poles,
                                        const choose::Case& holder) {
    const design::TunedRational tuned = design::tune_rational(rival.rule, goal, poles);
    const choose::Held held =
        choose::hold(holder.first, holder.second, goal, design::as_modes(rival.rule, goal, poles, tuned));
    return held.fault.empty() ? std::optional(held.added_to(design::certified_error(held.filter, goal)).largest())
           : rival.cascade    ? std::nullopt
                              : std::optional(tuned.error);
}

std::vector<Asked> points_of(const BandStudy& study, const Case& of) {
    const design::DerivativeGoal goal{of.order, study.step_s, of.band, {}};
    std::vector<Asked> points;
    choose::DerivativeErrors errors(goal);
    for (const char* kernel : kernels) {
        if (!serves(kernel, of.order)) {
            continue;
        }
        for (std::size_t taps = 3; taps <= study.longest; ++taps) {
            const choose::ErrorAt at = errors.error(kernel, taps);
            const std::size_t modes =
                choose::CountedOrder(of.order, true).length(kernel, taps, longest_length).modes.value_or(0);
            if (at.fault.empty() && modes > 0) {
                points.push_back({point_of(of, kernel, taps - 2 * modes, modes, at.error), {kernel, taps}});
            }
        }
    }
    for (const Rival& rival : rivals) {
        if (!design::has_rational(of.order)) {
            continue;
        }
        for (const std::size_t poles : study.poles) {
            const choose::Case holder{kernel_of(rival, of.order), 1 + 2 * poles};
            if (const auto error = error_of_rational(rival, goal, poles, holder)) {
                points.push_back({point_of(of, rival.way, 1, poles, *error), holder});
            }
        }
    }
    return points;
}

void add_costs(choose::CostSource& source, const std::vector<Asked>& of_case, std::vector<BandPoint>& points) {
    std::vector<choose::Case> asked;
    for (const Asked& one : of_case) {
        asked.push_back(one.cost);
    }
    const std::vector<choose::Cost> costs = source.costs(asked);
    for (std::size_t j = 0; j < costs.size(); ++j) {
        BandPoint point = of_case[j].point;
        if (costs[j].fault.empty()) {
            point.model_cycles = costs[j].value;
            point.model_cycles_high = costs[j].limited;
            point.bytes = costs[j].bytes;
            points.push_back(point);
        }
    }
}

}  // namespace

const Rival* rival_of(const std::string& way) {
    const auto* const found = std::ranges::find(rivals, way, &Rival::way);
    return found == std::end(rivals) ? nullptr : found;
}

std::vector<BandPoint> measure_bands(const BandStudy& study, const CostsOfOrder& costs_of) {
    std::vector<Case> cases;
    for (const double order : study.orders) {
        for (const design::Band& band : study.bands) {
            cases.push_back({order, band});
        }
    }
    std::vector<std::vector<Asked>> found(cases.size());
    {
        base::Progress progress("orders and bands", cases.size());
        base::parallel_for(cases.size(), study.jobs, [&](std::size_t i) {
            found[i] = points_of(study, cases[i]);
            progress.advance();
        });
    }
    std::vector<BandPoint> points;
    auto of_case = found.begin();
    for (const double order : study.orders) {
        const auto costs = costs_of({order, true});
        for (std::size_t i = 0; i < study.bands.size(); ++i) {
            add_costs(*costs, *of_case++, points);
        }
    }
    return points;
}

std::vector<BandPoint> measure_bands(const BandStudy& study, const qemu::Board& board) {
    return measure_bands(study, [&](const choose::CountedOrder& order) {
        return std::make_unique<choose::OnTarget>(board, order, Sweep().samples, Sweep().seed, study.jobs, study.core);
    });
}

std::vector<BandRival> compare_bands(const std::vector<BandPoint>& points) {
    std::vector<BandRival> compared;
    for (const BandPoint& rival : points) {
        if (is_ours(rival)) {
            continue;
        }
        BandRival one{rival, {}};
        one.ours.error = std::numeric_limits<double>::infinity();
        for (const BandPoint& ours : points) {
            if (is_ours(ours) && ours.order == rival.order && ours.band == rival.band &&
                ours.model_cycles <= rival.model_cycles && ours.error < one.ours.error) {
                one.ours = ours;
            }
        }
        compared.push_back(one);
    }
    return compared;
}

std::vector<Json> rows_of_bands(const std::vector<BandPoint>& points) {
    std::vector<Json> rows;
    for (const BandPoint& point : points) {
        RowKey key;
        key.kind = RowKind::band;
        key.kernel = point.way;
        key.order = fmt::format("{}", point.order);
        key.taps = point.taps;
        key.hz = fmt::format("{}..{}", point.band.low_hz, point.band.high_hz);
        Row row(key, 1);
        row.set(Counter::band_error, point.error);
        row.set(Counter::model_cycles_per_sample, point.model_cycles);
        row.set(Counter::model_cycles_high, point.model_cycles_high);
        row.set(Counter::memory_bytes, point.bytes);
        rows.push_back(std::move(row).take());
    }
    return rows;
}

}  // namespace bench
