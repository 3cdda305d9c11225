#include "bench/host/host_timing.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "bench/host/benchmark_run.hpp"
#include "bench/host/cycle_counter.hpp"
#include "bench/host/time_line.hpp"
#include "bench/host/timed_kernels.hpp"
#include "bench/host/timed_peers.hpp"
#include "bench/host/timed_rows.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/exact_weights.hpp"
#include "glsum/catalogue.hpp"
#include "reference/dropped.hpp"
#include "reference/sums.hpp"

namespace bench {
namespace {

// What a kernel whose past has no end is checked on, from rest: so many samples behind its taps.
constexpr std::size_t record_from_rest = 1024;

using Weights = std::shared_ptr<const std::vector<reference::Real>>;

// A case, ready to be timed as often as is wanted: each time another line, at another place.
struct Prepared {
    std::function<std::unique_ptr<TimedLine>()> make;
    Weights weights;  // of the exact sum
    bool rests;       // its past has no end
};

// The exact weights of many cases, which share them.
class KnownWeights {
public:
    Weights of(const Timed& timed, reference::Dropped dropped, const glsum::Design& design, bool ends) {
        auto& weights = known_[{timed.order, named(timed.length, design), dropped, timed.weights}];
        if (!weights) {
            weights = std::make_shared<const std::vector<reference::Real>>(
                ends ? exact_weights(timed.weights, reference::Real(timed.order), design.taps)
                     : reference::weights_of(dropped, design, design.taps + record_from_rest));
        }
        return weights;
    }

private:
    std::map<std::tuple<double, std::string, reference::Dropped, Discretisation>, Weights> known_;
};

Prepared prepared(const Timed& timed, const TimedKernel& kernel, std::size_t samples, KnownWeights& known) {
    const glsum::Design design = design_of(timed.name, timed.order, timed.length, samples, timed.weights);
    const auto make = [&kernel, design] { return kernel.make(design); };
    if (!kernel.sums) {
        return {make, std::make_shared<const std::vector<reference::Real>>(1, reference::Real(1)), false};
    }
    const reference::Dropped dropped = facts_of(timed.name).forgotten;
    const bool ends = design.modes.empty() && design.blocks.count == 0 && dropped == reference::Dropped::zero;
    return {make, known.of(timed, dropped, design, ends), !ends};
}

Prepared prepared(const Timed& timed, const Peer& peer, KnownWeights& known) {
    const Weights weights = known.of(timed, reference::Dropped::zero, {timed.order, timed.length.taps}, true);
    return {[&peer, weights] { return timed_peer(peer, *weights); }, weights, false};
}

void add(const Timed& timed, const Prepared& prepared, bool repeated) {
    auto* registered =
        benchmark::RegisterBenchmark(to_name(row_key(timed.name, timed.order, timed.length, RowKey::host)).c_str(),
                                     [prepared](benchmark::State& state) {
                                         const std::unique_ptr<TimedLine> line = prepared.make();
                                         if (line->status() != glsum::Status::ok) {
                                             state.SkipWithError(to_text(line->status()).c_str());
                                             return;
                                         }
                                         time_line(state, *line, *prepared.weights, prepared.rests);
                                     });
    if (repeated) {
        const std::unique_ptr<TimedLine> line = prepared.make();
        registered->Iterations(
            iterations_for(line->status() == glsum::Status::ok ? estimated_ns(*line, prepared.weights->size()) : 0.0,
                           timed.length.taps));
    }
}

}  // namespace

HostTiming time_on_host(const std::vector<Timed>& cases, std::size_t samples, unsigned repetitions,
                        const std::vector<std::string>& flags) {
    // Random turns: what disturbs the machine for a while meets all kernels alike.
    std::vector<std::string> all_flags = {
        "--benchmark_min_time=0.02", fmt::format("--benchmark_repetitions={}", repetitions),
        fmt::format("--benchmark_enable_random_interleaving={}", repetitions > 1 ? "true" : "false")};
    all_flags.insert(all_flags.end(), flags.begin(), flags.end());
    set_benchmark_flags(all_flags);
    KnownWeights known;
    const std::vector<TimedKernel> kernels = timed_kernels();
    for (const Timed& timed : cases) {
        for (const TimedKernel& kernel : kernels) {
            if (kernel.name == timed.name) {
                add(timed, prepared(timed, kernel, samples, known), repetitions > 1);
            }
        }
        for (const Peer& peer : peers()) {
            if (peer.name == timed.name) {
                add(timed, prepared(timed, peer, known), repetitions > 1);
            }
        }
    }
    Json json = run_benchmarks(cases.size());
    HostTiming timing;
    timing.context = json["context"];
    timing.context["cycle_counter"] = CycleCounter::shared().name();
    timing.context["host_timing_order"] = fmt::format("{}", cases.front().order);
    for (auto& row : json["benchmarks"]) {
        drop_iterations(row, "name");
        drop_iterations(row, "run_name");
        timing.rows.push_back(std::move(row));
    }
    // As they were registered: repetitions that take turns end in any order.
    std::stable_sort(timing.rows.begin(), timing.rows.end(), [](const Json& a, const Json& b) {
        return a.value("family_index", 0) < b.value("family_index", 0);
    });
    return timing;
}

HostTiming time_on_host(const Sweep& sweep, const std::vector<std::string>& flags) {
    std::vector<Timed> cases;
    for (const Length& length : sweep.lengths) {
        if (!length.window()) {
            continue;
        }
        for (const std::string& name : sweep.kernels) {
            const auto order =
                std::find_if(sweep.orders.begin(), sweep.orders.end(), [&](double v) { return serves(name, v); });
            if (!has_modes(name) && !has_blocks(name) && order != sweep.orders.end() &&
                why_not_served(name, sweep.weights).empty()) {
                cases.push_back({name, length, *order, sweep.weights});
            }
        }
        for (const std::string& name : sweep.peers) {
            cases.push_back({name, length, sweep.orders.front(), sweep.weights});
        }
    }
    for (const std::string& kernel : sweep.kernels) {
        if (!has_modes(kernel) && !has_blocks(kernel)) {
            continue;
        }
        std::set<std::string> seen;
        for (const double order : sweep.orders) {
            for (const Length& length : lengths_of(sweep, kernel, order)) {
                if (seen.insert(length.text()).second) {
                    cases.push_back({kernel, length, order, sweep.weights});
                }
            }
        }
    }
    return cases.empty() ? HostTiming{} : time_on_host(cases, sweep.samples, sweep.repetitions, flags);
}

}  // namespace bench
