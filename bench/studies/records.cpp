#include "bench/studies/records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <string_view>

#include "base/failure.hpp"
#include "base/progress.hpp"
#include "bench/host/peers/fftw.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/run/context.hpp"
#include "bench/studies/record_case.hpp"
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
constexpr double peer_roundoff = 1e-9;  // of the largest sum: beyond it something else was computed

std::vector<double> by_blocks(const RecordTask& task) {
    drive::FastMemory memory(task.weights);
    std::vector<double> sums;
    sums.reserve(task.record.size());
    for (const double sample : task.record) {
        sums.push_back(task.weights[0] * sample + memory.past());
        memory.push(sample);
    }
    return sums;
}

RecordWay peer(const std::string& name, const std::string& label, std::size_t samples,
               FftwConvolution::Planning planning, double planning_s) {
    const std::size_t length = drive::RealTransform::fast_length(2 * samples - 1);
    const auto convolution = std::make_shared<FftwConvolution>(samples, length, planning, planning_s);
    return {.name = name,
            .label = label,
            .full_memory = true,
            .load = [convolution](const RecordTask& task) { convolution->load(task.weights, task.record); },
            .sums =
                [convolution, length](const RecordTask&) {
                    const std::span<const double> found = convolution->run();
                    std::vector<double> sums(found.begin(), found.end());
                    for (double& sum : sums) {
                        sum /= static_cast<double>(length);
                    }
                    return sums;
                },
            .timed = [convolution](const RecordTask&) { (void)convolution->run(); }};
}

// All that is measured at one order and size. Ours is planned before any peer is, so that nothing it measures serves
// us.
std::vector<RecordWay> make_ways(double order, std::size_t samples, double planning_s) {
    const auto window = std::make_shared<HostLine<Window>>(glsum::Design{order, window_taps});
    if (window->status() != glsum::Status::ok) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: {}", Window::name(), to_text(window->status())));
    }
    const auto by_window = [window](const RecordTask& task) {
        Window::reset(window->state());
        std::vector<double> sums;
        sums.reserve(task.record.size());
        for (const double sample : task.record) {
            sums.push_back(window->step(sample));
        }
        return sums;
    };
    const auto whole = [](const RecordTask& task) { return drive::whole_record_sums(task.weights, task.record); };
    const auto timed = [](auto sums) { return [sums](const RecordTask& task) { (void)sums(task); }; };
    std::vector<RecordWay> ways;
    ways.push_back({"whole_f64", "all sums at once", true, {}, whole, timed(whole)});
    ways.push_back(
        {"blocks_f64", "sample by sample; each may depend on the sum before", true, {}, by_blocks, timed(by_blocks)});
    ways.push_back({fmt::format("window{}_f64", window_taps),
                    std::string(Window::name()),
                    false,
                    {},
                    by_window,
                    timed(by_window)});
    ways.push_back(peer("peer_fftw_f64", "FFTW planned by its estimate as ours is", samples,
                        FftwConvolution::Planning::estimate, planning_s));
    ways.push_back(peer("peer_fftwmeasured_f64", fmt::format("FFTW planned by timing for {:g} s each way", planning_s),
                        samples, FftwConvolution::Planning::measure, planning_s));
    return ways;
}

void measure_errors(double order, const std::vector<std::string>& signals, std::vector<RecordSize>& sizes) {
    std::size_t work = 0;
    for (const RecordSize& size : sizes) {
        work += signals.size() * compared_samples(size.samples).size();
    }
    base::Progress progress(fmt::format("exact sums of order {}", order), work);
    const std::vector<reference::Real> exact_weights = reference::weights(reference::Real(order), sizes.back().samples);
    for (RecordSize& size : sizes) {
        for (const std::string& signal : signals) {
            const RecordTask task{size.task.weights, make_signal(signal, size.samples, Sweep().seed)};
            const std::vector<double> newest_first(task.record.rbegin(), task.record.rend());
            std::map<std::size_t, reference::Exact> exact;
            for (const std::size_t k : compared_samples(size.samples)) {
                exact.emplace(k, reference::Exact(reference::sum(
                                     exact_weights, std::span(newest_first).subspan(size.samples - 1 - k))));
                progress.advance();
            }
            const double allowed = allowed_error(task);
            double peak = 0.0;
            for (RecordWay& how : size.ways) {
                if (how.load) {
                    how.load(task);
                }
                const std::vector<double> sums = how.sums(task);
                if (peak == 0.0) {
                    std::for_each(sums.begin(), sums.end(), [&](double sum) { peak = std::max(peak, std::fabs(sum)); });
                }
                std::vector<double> errors;
                for (const auto& [k, sum] : exact) {
                    errors.push_back(sum.error_of(sums[k]));
                }
                judge(how, signal, errors, peak, how.name == "whole_f64" ? allowed : peer_roundoff * peak);
            }
        }
    }
}

}  // namespace

Study measure_records(const Records& wanted) {
    const auto& [samples, orders, signals, repetitions, planning_s] = wanted;
    Study study;
    study.text = fmt::format(
        "Sums with full memory over whole records in double: median of {} interleaved turns, processor time; {}.\n"
        "Planning is outside the timing. Errors relative to the largest sum, against 50 digits at {} samples of each "
        "signal.\n",
        repetitions, FftwConvolution::version(), compared_samples(samples.front()).size());
    for (const double order : orders) {
        std::vector<RecordSize> sizes;
        for (const std::size_t count : samples) {
            sizes.push_back(
                {count,
                 {drive::record_weights(order, count), bench::make_signal("noise", count, bench::Sweep().seed)},
                 {}});
            (void)drive::whole_record_sums(sizes.back().task.weights, sizes.back().task.record);
            (void)by_blocks(sizes.back().task);
        }
        for (RecordSize& size : sizes) {
            size.ways = make_ways(order, size.samples, planning_s);
        }
        measure_errors(order, signals, sizes);
        base::Progress progress(fmt::format("turns at order {}", order), repetitions * sizes.size());
        for (unsigned turn = 0; turn < repetitions; ++turn) {
            for (RecordSize& size : sizes) {
                for (RecordWay& how : size.ways) {
                    how.turns.push_back(time_once(how, size.task));
                }
                progress.advance();
            }
        }
        for (const RecordSize& size : sizes) {
            for (const RecordWay& how : size.ways) {
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
    study.context = make_context(Json(), sweep, {});
    study.context["records"] = samples;
    study.context["fftw"] = FftwConvolution::version();
    return study;
}

}  // namespace bench
