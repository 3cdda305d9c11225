#include "bench/studies/derivative.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/rounded_up.hpp"
#include "bench/choose/derivative_text.hpp"
#include "bench/choose/reach.hpp"
#include "bench/rows/front.hpp"
#include "bench/sweep/designs.hpp"

namespace bench {
namespace {

namespace design = glsum::design;

// At the shortest length that keeps the limit, and at the next: a near tap beside modes may cost more than a mode.
std::vector<DerivativePoint> points_of(choose::DerivativeErrors& errors, const design::DerivativeGoal& goal,
                                       const std::string& kernel, double limit) {
    const std::vector<std::size_t> lengths = errors.lengths(kernel).value();
    const choose::Reach reach = choose::reach_of(errors, kernel, lengths, limit);
    std::vector<std::size_t> wanted;
    if (reach.best.fault.empty()) {
        wanted.push_back(reach.shortest.value_or(reach.best_taps));
    }
    if (reach.shortest && has_modes(kernel) && *reach.shortest < lengths.back() &&
        errors.meets(kernel, *reach.shortest + 1, limit)) {
        wanted.push_back(*reach.shortest + 1);
    }
    std::vector<DerivativePoint> points;
    for (const std::size_t coefficients : wanted) {
        points.push_back({goal.order,
                          kernel,
                          coefficients,
                          choose::CountedOrder(goal.order, true).length(kernel, coefficients, longest_length).text(),
                          choose::report_on(kernel, coefficients, goal, errors.filter_of(kernel, coefficients)),
                          reach.shortest.has_value(),
                          {}});
    }
    return points;
}

// Of one order, in the order of the kernels that it has.
std::vector<DerivativePoint> points_of(const DerivativeStudy& study, const design::DerivativeGoal& goal,
                                       const std::vector<std::string>& kernels) {
    choose::DerivativeErrors errors(goal, study.by);
    std::vector<std::vector<DerivativePoint>> found(kernels.size());
    {
        base::Progress progress(fmt::format("order {}", goal.order), kernels.size());
        const std::vector<std::size_t> turns = choose::turns_of(errors, kernels);
        base::parallel_for(turns.size(), study.jobs, [&](std::size_t i) {
            found[turns[i]] = points_of(errors, goal, kernels[turns[i]], study.limit);
            progress.advance();
        });
    }
    std::vector<DerivativePoint> points;
    for (auto& of_kernel : found) {
        std::ranges::move(of_kernel, std::back_inserter(points));
    }
    return points;
}

void add_costs(const DerivativeStudy& study, std::vector<DerivativePoint>& points) {
    std::vector<choose::Case> cases;
    for (const DerivativePoint& point : points) {
        if (point.meets) {
            cases.emplace_back(point.kernel, point.coefficients);
        }
    }
    if (cases.empty()) {
        return;
    }
    for (const DerivativeTarget& target : study.targets) {
        const std::vector<choose::Cost> costs = target.costs({points.front().order, true})->costs(cases);
        auto cost = costs.begin();
        for (DerivativePoint& point : points) {
            if (point.meets) {
                point.costs.push_back(*cost++);
            }
        }
    }
}

}  // namespace

DerivativeRun measure_derivative(const DerivativeStudy& study) {
    DerivativeRun run;
    std::map<std::string, std::vector<std::string>> reasons;
    std::vector<std::string> all;
    for (const std::string& kernel : study.kernels) {
        const std::string why = choose::DerivativeErrors::why_not(kernel);
        (why.empty() ? all : reasons[why]).push_back(kernel);
    }
    for (const auto& [why, kernels] : reasons) {
        run.left_out.push_back(fmt::format("left out, since {}: {}", why, fmt::join(kernels, ", ")));
    }
    for (const design::DerivativeGoal& goal : study.goals) {
        std::vector<std::string> kernels;
        std::ranges::copy_if(all, std::back_inserter(kernels), [&](const std::string& kernel) {
            return !has_integrator(kernel) || serves(kernel, goal.order);
        });
        std::vector<DerivativePoint> points = points_of(study, goal, kernels);
        add_costs(study, points);
        std::ranges::move(points, std::back_inserter(run.points));
    }
    return run;
}

std::vector<Json> rows_of_derivative(const DerivativeStudy& study, const DerivativeRun& run) {
    std::vector<Json> rows;
    for (const DerivativePoint& point : run.points) {
        const design::DerivativeGoal& goal =
            *std::ranges::find(study.goals, point.order, &design::DerivativeGoal::order);
        RowKey key;
        key.kind = RowKind::derivative;
        key.kernel = point.kernel;
        key.order = fmt::format("{}", point.order);
        key.taps = point.taps;
        key.hz = goal.band ? fmt::format("{}..{}", goal.band->low_hz, goal.band->high_hz) : "";
        key.until = goal.step_until_s ? fmt::format("{}", *goal.step_until_s) : "";
        const auto row_at = [&](std::string_view aspect) {
            key.aspect = aspect;
            Row row(key, 1);
            if (goal.band) {
                row.set(Counter::band_error, point.report.certified.band);
                row.set(Counter::measured_band_error, point.report.measured.band);
            }
            if (goal.step_until_s) {
                row.set(Counter::step_error, point.report.certified.step);
                row.set(Counter::measured_step_error, point.report.measured.step);
            }
            return row;
        };
        if (!point.meets) {
            rows.push_back(std::move(row_at(RowKey::accuracy)).take());
        }
        for (std::size_t i = 0; i < point.costs.size(); ++i) {
            Row row = row_at(study.targets[i].aspect);
            const choose::Cost& cost = point.costs[i];
            if (!cost.fault.empty()) {
                row.mark_error(cost.fault);
            } else if (key.is_host()) {
                row.set_time(cost.value);
                row.set(Counter::cycles_per_sample, cost.limited);
            } else {
                row.set(Counter::model_cycles_per_sample, cost.value);
                row.set(Counter::model_cycles_high, cost.limited);
            }
            if (cost.fault.empty()) {
                row.set(Counter::memory_bytes, cost.bytes);
            }
            rows.push_back(std::move(row).take());
        }
    }
    return rows;
}

namespace {

// "3.94 %, 4.38 %": band and step, those that were asked for.
std::string text_of(const design::DerivativeError& error, const design::DerivativeGoal& goal) {
    const auto percent = [](double share) { return base::rounded_up(100.0 * share) + " %"; };
    std::string text = goal.band ? percent(error.band) : "";
    return goal.step_until_s ? text + (text.empty() ? "" : ", ") + percent(error.step) : text;
}

// Rows of one order that meet the limit, by their cost on one target, those that no other makes not worth it starred.
std::string table_of(const std::vector<const DerivativePoint*>& meets, std::size_t target,
                     const design::DerivativeGoal& goal, const std::string& aspect) {
    std::vector<const DerivativePoint*> by_cost = meets;
    std::erase_if(by_cost, [&](const DerivativePoint* one) { return !one->costs[target].fault.empty(); });
    std::ranges::stable_sort(by_cost, {}, [&](const DerivativePoint* one) { return one->costs[target].value; });
    std::vector<Point> points;
    for (const DerivativePoint* one : by_cost) {
        const choose::Cost& cost = one->costs[target];
        points.push_back({cost.value, one->report.certified.largest(), cost.bytes});
    }
    const std::vector<bool> front = on_front(points);
    std::string text =
        fmt::format("  {:<28} {:>6} {:>18} {:>18} {:>10} {:>9} {:>7}  {}\n", "kernel", "taps", "certified", "measured",
                    aspect == RowKey::host ? "ns" : "cycles", "at most", "bytes", aspect);
    for (std::size_t i = 0; i < by_cost.size(); ++i) {
        const DerivativePoint& one = *by_cost[i];
        const choose::Cost& cost = one.costs[target];
        text += fmt::format("  {:<28} {:>6} {:>18} {:>18} {:>10.1f} {:>9} {:>7.0f}{}\n", one.kernel, one.taps,
                            text_of(one.report.certified, goal), text_of(one.report.measured, goal), cost.value,
                            aspect == RowKey::host ? "" : fmt::format("{:.1f}", cost.limited), cost.bytes,
                            front[i] ? "  *" : "");
    }
    return text;
}

}  // namespace

std::string to_table(const DerivativeStudy& study, const DerivativeRun& run) {
    std::string text;
    for (const design::DerivativeGoal& goal : study.goals) {
        std::vector<const DerivativePoint*> meets;
        const DerivativePoint* nearest = nullptr;
        std::set<std::string> all;
        std::set<std::string> near;
        for (const DerivativePoint& point : run.points) {
            if (point.order != goal.order) {
                continue;
            }
            all.insert(point.kernel);
            if (point.meets) {
                meets.push_back(&point);
                near.insert(point.kernel);
            } else if (nearest == nullptr || point.report.certified.largest() < nearest->report.certified.largest()) {
                nearest = &point;
            }
        }
        text += fmt::format("\nOrder {}, within {:g} %{}: {} of {} kernels\n", goal.order, 100.0 * study.limit,
                            choose::extent(goal), near.size(), all.size());
        for (std::size_t target = 0; target < study.targets.size() && !meets.empty(); ++target) {
            text += table_of(meets, target, goal, study.targets[target].aspect);
        }
        if (nearest != nullptr) {
            text += fmt::format("  of the others the nearest: {} with {} taps, {} at best\n", nearest->kernel,
                                nearest->taps, text_of(nearest->report.certified, goal));
        }
    }
    for (const std::string& sentence : run.left_out) {
        text += fmt::format("\n{}", sentence);
    }
    return text + (run.left_out.empty() ? "" : "\n");
}

}  // namespace bench
