#include "bench/choose/candidate.hpp"

#include <tuple>

#include "bench/rows/front.hpp"
#include "bench/sweep/designs.hpp"

namespace choose {

bool fits(const Candidate& candidate, const Limits& limits) {
    return candidate.error.fault.empty() && candidate.cost.fault.empty() && candidate.error.error <= limits.max_error &&
           within(limits.max_cost, candidate.cost.limited) && within(limits.max_bytes, candidate.cost.bytes);
}

bool dominates(const Candidate& a, const Candidate& b) {
    const auto point = [](const Candidate& one) {
        return bench::Point{one.cost.value, one.error.error, one.cost.bytes};
    };
    return bench::dominates(point(a), point(b));
}

bool better(const Candidate& a, const Candidate& b) {
    return std::tie(a.cost.value, a.cost.bytes, a.error.error) < std::tie(b.cost.value, b.cost.bytes, b.error.error);
}

std::string taps_text(const Candidate& candidate, const CountedOrder& order, std::size_t samples) {
    return order.length(candidate.kernel, candidate.taps, samples).text();
}

void measure(CostSource& costs, const std::vector<Candidate*>& candidates) {
    std::vector<Case> cases;
    for (const Candidate* candidate : candidates) {
        cases.emplace_back(candidate->kernel, candidate->taps);
    }
    const std::vector<Cost> found = costs.costs(cases);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        candidates[i]->cost = found[i];
    }
}

}  // namespace choose
