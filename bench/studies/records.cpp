#include "bench/studies/records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string_view>

#include "base/failure.hpp"
#include "base/progress.hpp"
#include "bench/host/peers/fftw.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/run/context.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/sweep/sweep.hpp"
#include "drive/fast_memory.hpp"
#include "drive/real_transform.hpp"
#include "drive/whole_record.hpp"
#include "glsum/registry.hpp"
#include "reference/sums.hpp"

namespace bench {
namespace {

using Window = glsum::Sum<glsum::Mirror, glsum::Multi, glsum::F64>;

constexpr std::size_t window_taps = 600;
constexpr std::size_t samples_a_turn = 100'000;  // shorter records are taken several times a turn
constexpr double peer_roundoff = 1e-9;           // of the largest sum: beyond it something else was computed

struct Seconds {
    double wall;
    double processor;
};

double median(std::vector<double> values) {
    const std::size_t half = values.size() / 2;
    std::sort(values.begin(), values.end());
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

// One record and what it is weighted with.
struct Task {
    std::vector<double> weights;
    std::vector<double> record;
};

// One way to the sums of a record.
struct How {
    std::string name;
    std::string label;
    bool full_memory;
    std::function<void(const Task&)> load;                 // outside the timing; may be nothing
    std::function<std::vector<double>(const Task&)> sums;  // of the task that was loaded
    std::function<void(const Task&)> timed;                // the same without copies that only we need
    std::vector<Seconds> turns = {};
    double error_max = 0.0;  // relative to the largest sum
    std::string fault = {};

    [[nodiscard]] double processor_s() const {
        std::vector<double> values;
        for (const Seconds& turn : turns) {
            values.push_back(turn.processor);
        }
        return median(values);
    }
    [[nodiscard]] double wall_s() const {
        std::vector<double> values;
        for (const Seconds& turn : turns) {
            values.push_back(turn.wall);
        }
        return median(values);
    }
};

struct Size {
    std::size_t samples;
    Task task;
    std::vector<How> hows;
};

std::vector<double> by_blocks(const Task& task) {
    drive::FastMemory memory(task.weights);
    std::vector<double> sums;
    sums.reserve(task.record.size());
    for (const double sample : task.record) {
        sums.push_back(task.weights[0] * sample + memory.past());
        memory.push(sample);
    }
    return sums;
}

How peer(const std::string& name, const std::string& label, std::size_t samples, FftwConvolution::Planning planning) {
    const std::size_t length = drive::RealTransform::fast_length(2 * samples - 1);
    const auto convolution = std::make_shared<FftwConvolution>(samples, length, planning);
    return {.name = name,
            .label = label,
            .full_memory = true,
            .load = [convolution](const Task& task) { convolution->load(task.weights, task.record); },
            .sums =
                [convolution, length](const Task&) {
                    const std::span<const double> found = convolution->run();
                    std::vector<double> sums(found.begin(), found.end());
                    for (double& sum : sums) {
                        sum /= static_cast<double>(length);
                    }
                    return sums;
                },
            .timed = [convolution](const Task&) { (void)convolution->run(); }};
}

// All that is measured at one order and size. Ours is planned before any peer is, so that nothing it measures serves
// us.
std::vector<How> make_hows(double order, std::size_t samples) {
    const auto window = std::make_shared<HostLine<Window>>(glsum::Design{order, window_taps});
    if (window->status() != glsum::Status::ok) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: {}", Window::name(), to_text(window->status())));
    }
    const auto by_window = [window](const Task& task) {
        Window::reset(window->state());
        std::vector<double> sums;
        sums.reserve(task.record.size());
        for (const double sample : task.record) {
            sums.push_back(window->step(sample));
        }
        return sums;
    };
    const auto whole = [](const Task& task) { return drive::whole_record_sums(task.weights, task.record); };
    const auto timed = [](auto sums) { return [sums](const Task& task) { (void)sums(task); }; };
    std::vector<How> hows;
    hows.push_back({"whole_f64", "all sums at once", true, {}, whole, timed(whole)});
    hows.push_back(
        {"blocks_f64", "sample by sample; each may depend on the sum before", true, {}, by_blocks, timed(by_blocks)});
    hows.push_back({fmt::format("window{}_f64", window_taps),
                    std::string(Window::name()),
                    false,
                    {},
                    by_window,
                    timed(by_window)});
    hows.push_back(
        peer("peer_fftw_f64", "FFTW planned by its estimate as ours is", samples, FftwConvolution::Planning::estimate));
    hows.push_back(peer("peer_fftwmeasured_f64", "FFTW planned by timing for 5 s each way", samples,
                        FftwConvolution::Planning::measure));
    return hows;
}

// Where the sums are compared: the first, those about the borders of what is summed directly, some on the way, the
// last.
std::vector<std::size_t> points_of(std::size_t samples) {
    std::vector<std::size_t> points{0, 1, 2, 15, 16, 17, 127, 255, 256, 257};
    constexpr std::size_t parts = 12;
    for (std::size_t i = 1; i <= parts; ++i) {
        points.push_back((samples * i) / parts - 1);
    }
    return points;
}

void measure_errors(double order, const std::vector<std::string>& signals, std::vector<Size>& sizes) {
    std::size_t work = 0;
    for (const Size& size : sizes) {
        work += signals.size() * points_of(size.samples).size();
    }
    base::Progress progress(fmt::format("exact sums of order {}", order), work);
    const std::vector<reference::Real> exact_weights = reference::weights(reference::Real(order), sizes.back().samples);
    for (Size& size : sizes) {
        for (const std::string& signal : signals) {
            const Task task{size.task.weights, make_signal(signal, size.samples, Sweep().seed)};
            const std::vector<double> newest_first(task.record.rbegin(), task.record.rend());
            std::map<std::size_t, reference::Exact> exact;
            for (const std::size_t k : points_of(size.samples)) {
                exact.emplace(k, reference::Exact(reference::sum(
                                     exact_weights, std::span(newest_first).subspan(size.samples - 1 - k))));
                progress.advance();
            }
            // What the header promises of the given weights, and the rounding of these themselves.
            double allowed = drive::whole_record_error_bound(task.weights, task.record);
            for (const double weight : task.weights) {
                allowed += 0x1p-53 * signal_peak * std::fabs(weight);
            }
            double peak = 0.0;
            for (How& how : size.hows) {
                if (how.load) {
                    how.load(task);
                }
                const std::vector<double> sums = how.sums(task);
                if (peak == 0.0) {
                    std::for_each(sums.begin(), sums.end(), [&](double sum) { peak = std::max(peak, std::fabs(sum)); });
                }
                double error = 0.0;
                for (const auto& [k, sum] : exact) {
                    const double here = std::fabs(sum.error_of(sums[k]));
                    error = std::isnan(here) ? INFINITY : std::max(error, here);
                }
                how.error_max = std::max(how.error_max, error / peak);
                const bool ours = how.name == "whole_f64";
                const double limit = ours ? allowed : peer_roundoff * peak;
                if (how.full_memory && !(error <= limit)) {
                    how.fault = fmt::format("{}: wrong answer: error {:.3g} beyond {:.3g}", signal, error, limit);
                }
            }
        }
    }
}

Seconds time_once(const How& how, const Task& task) {
    Seconds sum{0.0, 0.0};
    const std::size_t runs = std::max<std::size_t>(1, samples_a_turn / task.record.size());
    for (std::size_t i = 0; i < runs; ++i) {
        if (how.load) {
            how.load(task);
        }
        const auto begin = std::chrono::steady_clock::now();
        const std::clock_t start = std::clock();  // of the processor: others on the machine do not count
        how.timed(task);
        sum.processor += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        sum.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    return {sum.wall / static_cast<double>(runs), sum.processor / static_cast<double>(runs)};
}

const How& find(const Size& size, std::string_view name) {
    return *std::find_if(size.hows.begin(), size.hows.end(), [&](const How& how) { return how.name == name; });
}

// Of the turns' ratios, the median: what disturbs the machine for a while is in both.
double ratio(const How& how, const How& other) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < how.turns.size(); ++i) {
        ratios.push_back(how.turns[i].processor / other.turns[i].processor);
    }
    return median(ratios);
}

Json to_row(double order, const Size& size, const How& how) {
    RowKey key;
    key.kind = RowKind::record;
    key.kernel = how.name;
    key.order = fmt::format("{}", order);
    key.samples = std::to_string(size.samples);
    key.aspect = RowKey::host;
    Row row(key, size.samples);
    const auto samples = static_cast<double>(size.samples);
    row.set_text("label", how.label);
    row.set(Counter::real_time, 1e9 * how.wall_s() / samples);
    row.set(Counter::cpu_time, 1e9 * how.processor_s() / samples);
    row.set(Counter::ns_per_sample, 1e9 * how.processor_s() / samples);
    row.set(Counter::record_ms, 1e3 * how.processor_s());
    row.set(Counter::turns, how.turns.size());
    row.set(Counter::times_peer, ratio(how, find(size, "peer_fftw_f64")));
    row.set(Counter::times_measured_peer, ratio(how, find(size, "peer_fftwmeasured_f64")));
    row.set(Counter::error_max, how.error_max);
    row.set(Counter::sums_compared, points_of(size.samples).size());
    if (!how.fault.empty()) {
        row.mark_error(how.fault);
    }
    return std::move(row).take();
}

std::string to_table(double order, const std::vector<Size>& sizes) {
    std::string text =
        fmt::format("\nOrder {}\n  {:>8}  {:<22} {:>11} {:>11} {:>10} {:>13} {:>12} {:>10}\n", order, "samples", "how",
                    "ms a record", "ns a sample", "times peer", "times measured", "of size before", "error max");
    for (std::size_t s = 0; s < sizes.size(); ++s) {
        for (const How& how : sizes[s].hows) {
            const std::string growth = s == 0 ? "-" : fmt::format("{:.1f}", ratio(how, find(sizes[s - 1], how.name)));
            text += fmt::format(
                "  {:>8}  {:<22} {:>11.3f} {:>11.1f} {:>10.2f} {:>14.2f} {:>14} {:>10.1e}{}\n", sizes[s].samples,
                how.name, 1e3 * how.processor_s(), 1e9 * how.processor_s() / static_cast<double>(sizes[s].samples),
                ratio(how, find(sizes[s], "peer_fftw_f64")), ratio(how, find(sizes[s], "peer_fftwmeasured_f64")),
                growth, how.error_max, how.fault.empty() ? "" : fmt::format("  WRONG: {}", how.fault));
        }
    }
    return text;
}

}  // namespace

Study measure_records(const Records& wanted) {
    const auto& [samples, orders, signals, repetitions] = wanted;
    Study study;
    study.text = fmt::format(
        "Sums with full memory over whole records in double: median of {} interleaved turns, processor time; {}.\n"
        "Planning is outside the timing. Errors relative to the largest sum, against 50 digits at {} samples of each "
        "signal.\n",
        repetitions, FftwConvolution::version(), points_of(samples.front()).size());
    for (const double order : orders) {
        std::vector<Size> sizes;
        for (const std::size_t count : samples) {
            sizes.push_back(
                {count,
                 {drive::record_weights(order, count), bench::make_signal("noise", count, bench::Sweep().seed)},
                 {}});
            (void)drive::whole_record_sums(sizes.back().task.weights, sizes.back().task.record);
            (void)by_blocks(sizes.back().task);
        }
        for (Size& size : sizes) {
            size.hows = make_hows(order, size.samples);
        }
        measure_errors(order, signals, sizes);
        base::Progress progress(fmt::format("turns at order {}", order), repetitions * sizes.size());
        for (unsigned turn = 0; turn < repetitions; ++turn) {
            for (Size& size : sizes) {
                for (How& how : size.hows) {
                    how.turns.push_back(time_once(how, size.task));
                }
                progress.advance();
            }
        }
        for (const Size& size : sizes) {
            for (const How& how : size.hows) {
                study.rows.push_back(to_row(order, size, how));
                study.wrong += how.fault.empty() ? 0 : 1;
            }
        }
        study.text += to_table(order, sizes);
    }
    Sweep sweep;
    sweep.targets = {"host"};
    sweep.cores.clear();
    sweep.samples = samples.back();
    sweep.orders = orders;
    sweep.signals = signals;
    sweep.repetitions = repetitions;
    study.context = make_context(Json(), sweep, nullptr);
    study.context["records"] = samples;
    study.context["fftw"] = FftwConvolution::version();
    return study;
}

}  // namespace bench
