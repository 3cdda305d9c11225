// What a run recommends: for each order and error the cheapest kernel, beside the cheapest window; and which kernels
// nothing recommends.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/report/curves.hpp"

namespace bench::report {

/// Limits of `error_max`, the worst of the signals.
inline constexpr std::array<double, 4> error_limits = {1e-2, 1e-3, 1e-4, 1e-6};

/// The orders of the points, in the order of appearance.
[[nodiscard]] std::vector<std::string> orders_of(const std::vector<CurvePoint>& points);

enum class Memory { any, window };

/// The cheapest of the order's ranked points that errs no more, of two that cost the same the more exact; null: none.
[[nodiscard]] const CurvePoint* cheapest(const std::vector<CurvePoint>& points, const Cost& cost,
                                         const std::string& order, double limit, Memory memory);

struct Best {
    std::string order;
    double limit;
    const CurvePoint* point = nullptr;   ///< the cheapest that errs no more; none: no kernel of the run does
    const CurvePoint* window = nullptr;  ///< the cheapest of those whose length is a window's
};

/// For each order, in the order of appearance, and each limit. \param cost  index into the costs of the points
[[nodiscard]] std::vector<Best> best_of(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs,
                                        std::size_t cost);

/// Kernels with that cost that are on its front at no order and no length, in the order of appearance.
[[nodiscard]] std::vector<std::string> never_on_front(const std::vector<CurvePoint>& points,
                                                      const std::vector<Cost>& costs, std::size_t cost);

/// The cost that decides for a user: modelled cycles of the first core, else instructions, else the host's time; empty
/// where a run has none of them.
[[nodiscard]] std::optional<std::size_t> deciding_cost(const std::vector<Cost>& costs);

/// As a person reads it; empty for a run without errors or costs.
[[nodiscard]] std::string best_table(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs);

}  // namespace bench::report
