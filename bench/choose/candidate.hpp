// A kernel at a length with what it costs, and the limits that it is held against.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/choose/costs.hpp"
#include "bench/choose/errors.hpp"

namespace choose {

/// What may not be exceeded. Cost is in `CostSource::limited_unit()`.
struct Limits {
    double max_error;
    std::optional<double> max_cost;
    std::optional<double> max_bytes;
};

/// A kernel at a length, with everything measured there.
struct Candidate {
    std::string kernel;
    std::size_t taps = 0;
    ErrorAt error;
    Cost cost;
};

[[nodiscard]] inline bool within(const std::optional<double>& limit, double value) { return !limit || value <= *limit; }
[[nodiscard]] bool fits(const Candidate& candidate, const Limits& limits);
/// Whether `a` makes `b` not worth its cost (bench/rows/front.hpp), bytes included.
[[nodiscard]] bool dominates(const Candidate& a, const Candidate& b);
/// Whether `a` is to be preferred: cheaper, then smaller, then more accurate.
[[nodiscard]] bool better(const Candidate& a, const Candidate& b);

/// Its length as rows have it: "600", or "2+7" of near taps and modes or blocks.
[[nodiscard]] std::string taps_text(const Candidate& candidate, const CountedOrder& order, std::size_t samples);

/// Measures the costs of all of them at once.
void measure(CostSource& costs, const std::vector<Candidate*>& candidates);

}  // namespace choose
