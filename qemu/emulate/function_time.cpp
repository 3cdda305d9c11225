#include "qemu/emulate/function_time.hpp"

#include <algorithm>
#include <iterator>

namespace qemu {
namespace {

// How often a quantity had each value.
class Distribution {
public:
    void add(std::int64_t value, std::uint64_t times) {
        counts_[value] += times;
        total_ += times;
    }
    [[nodiscard]] Spread spread() const {
        Spread spread{counts_.begin()->first, 0, counts_.rbegin()->first};
        std::uint64_t seen = 0;
        for (const auto& [value, times] : counts_) {
            seen += times;
            if (2 * seen >= total_) {
                spread.median = value;
                break;
            }
        }
        return spread;
    }

private:
    std::map<std::int64_t, std::uint64_t> counts_;
    std::uint64_t total_ = 0;
};

}  // namespace

FunctionTime function_time(const timing::TimingLog& log, std::size_t core) {
    Distribution instructions;
    std::vector<Distribution> sets(log.runs.front().call.cores.at(core).half_cycles.size());
    std::vector<Distribution> alone(log.runs.front().call.cores.at(core).sets.size());
    std::array<Distribution, timing::effect_count> lost;
    Distribution in_double;
    FunctionTime time;
    for (const timing::TimedRun& run : log.runs) {
        time.calls += run.calls;
        time.stack_bytes = std::max(time.stack_bytes, run.call.stack_bytes);
        instructions.add(static_cast<std::int64_t>(run.call.instructions), run.calls);
        const timing::CoreTime& taken = run.call.cores.at(core);
        for (std::size_t s = 0; s < sets.size(); ++s) {
            sets[s].add(taken.half_cycles[s], run.calls);
        }
        for (std::size_t s = 0; s < alone.size(); ++s) {
            alone[s].add(taken.sets.at(s), run.calls);
        }
        for (std::size_t e = 0; e < lost.size(); ++e) {
            lost[e].add(taken.losses[e], run.calls);
        }
        in_double.add(taken.double_in_software, run.calls);
    }
    time.instructions = instructions.spread();
    time.nominal = sets.front().spread();
    time.low = time.high = time.nominal.median;
    for (const Distribution& set : sets) {
        time.low = std::min(time.low, set.spread().median);
        time.high = std::max(time.high, set.spread().median);
    }
    std::transform(alone.begin(), alone.end(), std::back_inserter(time.sets),
                   [](const Distribution& one) { return one.spread(); });
    std::transform(lost.begin(), lost.end(), time.lost.begin(), [](const Distribution& one) { return one.spread(); });
    time.in_double = in_double.spread();
    if (!log.hot.empty()) {
        time.hot.assign(log.hot.at(core).begin(), log.hot.at(core).end());
    }
    std::stable_sort(time.hot.begin(), time.hot.end(),
                     [](const auto& a, const auto& b) { return a.second.half_cycles > b.second.half_cycles; });
    time.unknown = log.unknown;
    time.recursive = log.recursive;
    return time;
}

}  // namespace qemu
