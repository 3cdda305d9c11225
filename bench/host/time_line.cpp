#include "bench/host/time_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/host/cycle_counter.hpp"
#include "bench/rows/row.hpp"
#include "bench/sweep/signals.hpp"
#include "reference/sums.hpp"

namespace bench {
namespace {

void set(benchmark::State& state, Counter counter, double value) {
    state.counters[std::string(name_of(counter))] = value;
}

// How far the output `found` of sample k is from the exact sum.
double error_of(const std::vector<reference::Real>& weights, std::size_t k, double found) {
    std::vector<double> newest_first;
    for (std::size_t j = 0; j < weights.size(); ++j) {
        newest_first.push_back(stream()[(k - j) % stream_samples]);
    }
    return std::fabs(reference::Exact(reference::sum(weights, newest_first)).error_of(found));
}

}  // namespace

const std::vector<double>& stream() {
    static const std::vector<double> samples = make_signal("noise", stream_samples, 1);
    return samples;
}

double estimated_ns(TimedLine& line, std::size_t taps) {
    constexpr int tries = 50;
    constexpr std::size_t steps = 64;
    std::size_t k = taps + 1;
    line.feed(0, k);
    double shortest = 1e9;
    for (int i = 0; i < tries; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        line.feed(k, steps);
        const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
        k += steps;
        shortest = std::min(shortest, took.count() / static_cast<double>(steps));
    }
    return shortest;
}

void time_line(benchmark::State& state, TimedLine& line, const std::vector<reference::Real>& weights, bool rests) {
    const CycleCounter& counter = CycleCounter::shared();
    std::size_t k = weights.size() + 1;  // into the steady state: the whole window holds samples
    line.feed(0, k);
    const std::uint64_t begin = counter.read();
    // All iterations in one batch: the loop over samples is the line's own.
    while (state.KeepRunningBatch(state.max_iterations)) {
        line.feed(k, static_cast<std::size_t>(state.max_iterations));
    }
    const std::uint64_t cycles = counter.read() - begin;
    k += static_cast<std::size_t>(state.iterations());
    if (rests) {
        line.rest();
        if (weights.size() > 1) {
            line.feed(k - (weights.size() - 1), weights.size() - 1);
        }
    }
    const double error = error_of(weights, k, line.feed(k, 1));
    if (const double bound = line.bound(weights.size()); !(error <= bound)) {
        state.SkipWithError(fmt::format("wrong answer: error {} beyond its bound {}", error, bound).c_str());
        return;
    }
    set(state, Counter::cycles_per_sample, static_cast<double>(cycles) / static_cast<double>(state.iterations()));
    state.counters[std::string(name_of(Counter::ns_per_sample))] =
        benchmark::Counter(1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    if (const auto sizes = line.sizes()) {
        set(state, Counter::macs_per_sample, static_cast<double>(sizes->macs));
        set(state, Counter::coefficient_bytes, static_cast<double>(sizes->coefficient_bytes));
        set(state, Counter::state_bytes, static_cast<double>(sizes->state_bytes));
    }
}

}  // namespace bench
