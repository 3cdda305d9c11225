#include "bench/host/host_timing.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <random>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/failure.hpp"
#include "base/progress.hpp"
#include "bench/host/cycle_counter.hpp"
#include "bench/host/peer_numbers.hpp"
#include "bench/host/timed_rows.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/exact_weights.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/bound.hpp"
#include "glsum/registry.hpp"
#include "reference/dropped.hpp"
#include "reference/sums.hpp"

namespace bench {
namespace {

// A power of two, so that the index needs no division; long enough that no branch predictor learns the data.
constexpr std::size_t stream_samples = 1 << 14;

// What a kernel whose past has no end is checked on, from rest: so many samples behind its taps.
constexpr std::size_t record_from_rest = 1024;

const std::vector<double>& stream() {
    static const std::vector<double> samples = make_signal("noise", stream_samples, 1);
    return samples;
}

const CycleCounter& cycle_counter() {
    static const CycleCounter counter;
    return counter;
}

// Where the data of a timing lie decides up to a tenth of its time (which stores and loads share the low bits of their
// addresses, for one), and a process would keep one draw for all of its repetitions. So each repetition draws anew, and
// what placement does shows as the repetitions' spread instead of as a difference between runs.
class Places {
public:
    std::size_t next() { return generator_() % Placement::lines; }
    Placement placement() {
        const std::size_t table = next();
        return {table, next()};
    }

private:
    std::mt19937_64 generator_{1};
};

Places& places() {
    static Places places;
    return places;
}

// An object that begins at a drawn place.
template <class T>
class Placed {
public:
    template <class... Arguments>
    explicit Placed(Arguments&&... arguments) : memory_(sizeof(T) + (Placement::lines + 1) * Placement::line_bytes) {
        void* place = memory_.data() + places().next() * Placement::line_bytes;
        std::size_t space = sizeof(T) + Placement::line_bytes;
        object_ =
            new (std::align(Placement::line_bytes, sizeof(T), place, space)) T(std::forward<Arguments>(arguments)...);
    }
    Placed(const Placed&) = delete;
    Placed& operator=(const Placed&) = delete;
    ~Placed() { object_->~T(); }
    T& operator*() { return *object_; }

private:
    std::vector<std::byte> memory_;
    T* object_;
};

// Checks the output `found` of sample k and counts the cycles.
void report(benchmark::State& state, const std::vector<reference::Real>& weights, std::size_t k, double found,
            double bound, std::uint64_t cycles) {
    std::vector<double> newest_first;
    for (std::size_t j = 0; j < weights.size(); ++j) {
        newest_first.push_back(stream()[(k - j) % stream_samples]);
    }
    const double error = std::fabs(reference::Exact(reference::sum(weights, newest_first)).error_of(found));
    if (!(error <= bound)) {
        state.SkipWithError(fmt::format("wrong answer: error {} beyond its bound {}", error, bound).c_str());
        return;
    }
    state.counters[std::string(name_of(Counter::cycles_per_sample))] =
        static_cast<double>(cycles) / static_cast<double>(state.iterations());
    state.counters[std::string(name_of(Counter::ns_per_sample))] =
        benchmark::Counter(1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Runs `step` on the stream for as long as Google Benchmark wants, then checks the output that follows.
// step: sample index -> output, as a real; expected_error: its bound; rest: empties a past that never ends otherwise,
// nothing where the weights are all of it.
// Without a state, only an estimate of the time per sample in ns is returned: the shortest of some short tries.
template <class Sample, class Step, class ToReal>
double time_line(benchmark::State* state, const std::vector<Sample>& samples,
                 const std::vector<reference::Real>& weights, double bound, Step step, ToReal to_real,
                 const std::function<void()>& rest = {}) {
    std::size_t k = 0;
    for (; k < weights.size() + 1; ++k) {  // into the steady state: the whole window holds samples
        benchmark::DoNotOptimize(step(samples[k % stream_samples]));
    }
    if (state == nullptr) {
        constexpr int tries = 50;
        constexpr int steps = 64;
        double shortest = 1e9;
        for (int i = 0; i < tries; ++i) {
            const auto begin = std::chrono::steady_clock::now();
            for (int j = 0; j < steps; ++j) {
                benchmark::DoNotOptimize(step(samples[k++ % stream_samples]));
            }
            const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
            shortest = std::min(shortest, took.count() / steps);
        }
        return shortest;
    }
    const std::uint64_t begin = cycle_counter().read();
    for ([[maybe_unused]] auto _ : *state) {
        benchmark::DoNotOptimize(step(samples[k++ % stream_samples]));
    }
    const std::uint64_t cycles = cycle_counter().read() - begin;
    if (rest) {
        rest();
        for (std::size_t j = weights.size() - 1; j > 0; --j) {
            step(samples[(k - j) % stream_samples]);
        }
    }
    report(*state, weights, k, to_real(step(samples[k % stream_samples])), bound, cycles);
    return 0.0;
}

void set_sizes(benchmark::State* state, std::size_t macs, std::size_t coefficient_bytes, std::size_t state_bytes) {
    if (state != nullptr) {
        state->counters[std::string(name_of(Counter::macs_per_sample))] = static_cast<double>(macs);
        state->counters[std::string(name_of(Counter::coefficient_bytes))] = static_cast<double>(coefficient_bytes);
        state->counters[std::string(name_of(Counter::state_bytes))] = static_cast<double>(state_bytes);
    }
}

template <class K>
bool ends_with_window(const glsum::Design& design) {
    if constexpr (std::is_same_v<K, glsum::Null>) {
        return true;
    } else {
        return design.modes.empty() && design.blocks.count == 0 &&
               reference::dropped_by<typename K::HistoryPart>() == reference::Dropped::zero;
    }
}

template <class K>
double time_kernel(benchmark::State* state, const glsum::Design& design, const std::vector<reference::Real>& weights) {
    Placed<HostLine<K>> placed(design, places().placement());
    HostLine<K>& line = *placed;
    if (line.status() != glsum::Status::ok) {
        if (state != nullptr) {
            state->SkipWithError(to_text(line.status()).c_str());
        }
        return 0.0;
    }
    std::vector<typename K::Sample> samples;
    for (const double x : stream()) {
        samples.push_back(K::from_real(x));
    }
    const auto step = [&](typename K::Sample x) { return line.step(x); };
    const auto to_real = [&](typename K::Output y) { return K::to_real(line.state(), y); };
    if constexpr (std::is_same_v<K, glsum::Null>) {
        return time_line(state, samples, {reference::Real(1)}, 1e-7, step, to_real);
    } else {
        std::function<void()> rest;
        if (!ends_with_window<K>(design)) {
            rest = [&] { K::reset(line.state()); };
        }
        const double bound = glsum::error_bound<K>(design, line.state(), signal_peak, weights.size());
        const double ns = time_line(state, samples, weights, bound, step, to_real, rest);
        set_sizes(state, K::multiplications(design.taps), line.coefficient_bytes(), line.state_bytes());
        return ns;
    }
}

// What a kernel's type gives to its timing; the rest is compiled once.
struct Kernel {
    std::string_view name;
    reference::Dropped dropped;
    bool (*ends_with_window)(const glsum::Design& design);
    double (*time)(benchmark::State* state, const glsum::Design& design, const std::vector<reference::Real>& weights);
};

std::vector<Kernel> kernels() {
    std::vector<Kernel> all;
    glsum::Registry::for_each([&]<class K>() {
        reference::Dropped dropped{};
        if constexpr (requires { typename K::HistoryPart; }) {
            dropped = reference::dropped_by<typename K::HistoryPart>();
        }
        all.push_back({K::name(), dropped, ends_with_window<K>, time_kernel<K>});
    });
    return all;
}

template <class Dot>
double time_peer(benchmark::State* state, MakeDot<Dot> make, const std::vector<reference::Real>& weights) {
    const PeerTable table(weights);
    const PeerNumbers<Dot> numbers(table);
    const std::size_t taps = weights.size();
    std::vector<typename Dot::Sample> coefficients;
    for (const double coefficient : table.coefficients) {
        coefficients.push_back(numbers.coefficient(coefficient));
    }
    Placed<PeerLine<Dot>> placed(make, coefficients,
                                 places().next() * Placement::line_bytes / sizeof(typename Dot::Sample));
    PeerLine<Dot>& line = *placed;
    std::vector<typename Dot::Sample> samples;
    for (const double x : stream()) {
        samples.push_back(numbers.sample(x));
    }
    const double ns = time_line(
        state, samples, weights, numbers.bound(table), [&](auto x) { return line.step(x); },
        [&](auto sum) { return numbers.real(sum); });
    set_sizes(state, taps, taps * sizeof(typename Dot::Sample), 2 * taps * sizeof(typename Dot::Sample));
    return ns;
}

// Writes what Google Benchmark's own JSON reporter writes, and shows the progress.
class Reporter : public benchmark::JSONReporter {
public:
    explicit Reporter(std::size_t benchmarks) : progress_("host timing", benchmarks) {
        SetOutputStream(&out_);
        SetErrorStream(&errors_);
    }
    void ReportRuns(const std::vector<Run>& runs) override {
        // A variation of counters that are 0, as the coefficients of one tap are, is no number, and NaN no JSON.
        std::vector<Run> finite = runs;
        for (Run& run : finite) {
            std::erase_if(run.counters, [](const auto& counter) { return !std::isfinite(counter.second.value); });
        }
        JSONReporter::ReportRuns(finite);
        if (!runs.empty() && runs.front().run_type != Run::RT_Aggregate) {
            progress_.advance();
        }
    }
    [[nodiscard]] Json json() const { return Json::parse(out_.str()); }

private:
    base::Progress progress_;
    std::ostringstream out_;
    std::ostringstream errors_;
};

void initialise(const std::vector<std::string>& flags, bool quick_default) {
    static std::vector<std::string> words;  // Google Benchmark keeps the pointer to the first
    words = {"glsum bench"};
    if (quick_default) {
        words.emplace_back("--benchmark_min_time=0.02");
    }
    words.insert(words.end(), flags.begin(), flags.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    int count = static_cast<int>(argv.size());
    benchmark::Initialize(&count, argv.data());
    if (count > 1) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: not a flag of Google Benchmark {}", argv[1], "(--benchmark_...)"));
    }
}

}  // namespace

HostTiming time_on_host(const std::vector<Timed>& cases, std::size_t samples, unsigned repetitions,
                        const std::vector<std::string>& flags) {
    // Random turns: what disturbs the machine for a while meets all kernels alike. Google Benchmark keeps its flags
    // from one run to the next, so that each says all that it wants.
    std::vector<std::string> words = {
        fmt::format("--benchmark_repetitions={}", repetitions),
        fmt::format("--benchmark_enable_random_interleaving={}", repetitions > 1 ? "true" : "false")};
    words.insert(words.end(), flags.begin(), flags.end());  // the later ones count
    initialise(words, true);
    const auto add = [&](const Timed& timed, const std::function<double(benchmark::State*)>& work) {
        auto* registered =
            benchmark::RegisterBenchmark(to_name(row_key(timed.name, timed.order, timed.length, RowKey::host)).c_str(),
                                         [work](benchmark::State& state) { work(&state); });
        if (repetitions > 1) {
            registered->Iterations(iterations_for(work(nullptr), timed.length.taps));
        }
    };
    using Weights = std::shared_ptr<const std::vector<reference::Real>>;
    std::map<std::tuple<double, std::string, reference::Dropped, Discretisation>, Weights> known;
    const auto weights_of = [&](const Timed& timed, reference::Dropped dropped, const glsum::Design& design,
                                bool ends) {
        auto& weights = known[{timed.order, named(timed.length, design), dropped, timed.weights}];
        if (!weights) {
            weights = std::make_shared<const std::vector<reference::Real>>(
                ends ? exact_weights(timed.weights, reference::Real(timed.order), design.taps)
                     : reference::weights_of(dropped, design, design.taps + record_from_rest));
        }
        return weights;
    };
    const std::vector<Kernel> all = kernels();
    for (const Timed& timed : cases) {
        for (const Kernel& kernel : all) {
            if (kernel.name == timed.name) {
                const glsum::Design design = design_of(timed.name, timed.order, timed.length, samples, timed.weights);
                const Weights weights = weights_of(timed, kernel.dropped, design, kernel.ends_with_window(design));
                add(timed, [&kernel, design, weights](benchmark::State* state) {
                    return kernel.time(state, design, *weights);
                });
            }
        }
        for (const Peer& peer : peers()) {
            if (peer.name == timed.name) {
                const Weights weights =
                    weights_of(timed, reference::Dropped::zero, {timed.order, timed.length.taps}, true);
                add(timed, [&peer, weights](benchmark::State* state) {
                    return std::visit([&](auto make) { return time_peer(state, make, *weights); }, peer.make);
                });
            }
        }
    }
    Json json;
    {
        Reporter reporter(cases.size());
        const std::size_t ran = benchmark::RunSpecifiedBenchmarks(&reporter);
        benchmark::ClearRegisteredBenchmarks();
        if (ran == 0) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 "--benchmark_filter: expected to match some timing, found none that it does");
        }
        json = reporter.json();
    }
    HostTiming timing;
    timing.context = json["context"];
    timing.context["cycle_counter"] = cycle_counter().name();
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
