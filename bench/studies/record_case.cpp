#include "bench/studies/record_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "bench/rows/key.hpp"
#include "bench/sweep/signals.hpp"
#include "drive/whole_record.hpp"

namespace bench {
namespace {

constexpr std::size_t samples_a_turn = 100'000;

double median_of(const std::vector<Seconds>& turns, double Seconds::*time) {
    std::vector<double> values;
    for (const Seconds& turn : turns) {
        values.push_back(turn.*time);
    }
    return median(values);
}

}  // namespace

double RecordWay::processor_s() const { return median_of(turns, &Seconds::processor); }

double RecordWay::wall_s() const { return median_of(turns, &Seconds::wall); }

const RecordWay& RecordSize::way(std::string_view name) const {
    return *std::find_if(ways.begin(), ways.end(), [&](const RecordWay& one) { return one.name == name; });
}

double median(std::vector<double> values) {
    const std::size_t half = values.size() / 2;
    std::sort(values.begin(), values.end());
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double ratio(const RecordWay& way, const RecordWay& other) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < way.turns.size(); ++i) {
        ratios.push_back(way.turns[i].processor / other.turns[i].processor);
    }
    return median(ratios);
}

std::size_t runs_a_turn(std::size_t samples) { return std::max<std::size_t>(1, samples_a_turn / samples); }

Seconds time_once(const RecordWay& way, const RecordTask& task) {
    Seconds sum{0.0, 0.0};
    const std::size_t runs = runs_a_turn(task.record.size());
    for (std::size_t i = 0; i < runs; ++i) {
        if (way.load) {
            way.load(task);
        }
        const auto begin = std::chrono::steady_clock::now();
        const std::clock_t start = std::clock();  // of the processor: others on the machine do not count
        way.timed(task);
        sum.processor += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        sum.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    return {sum.wall / static_cast<double>(runs), sum.processor / static_cast<double>(runs)};
}

std::vector<std::size_t> compared_samples(std::size_t samples) {
    std::vector<std::size_t> points{0, 1, 2, 15, 16, 17, 127, 255, 256, 257};
    constexpr std::size_t parts = 12;
    for (std::size_t i = 1; i <= parts; ++i) {
        points.push_back((samples * i) / parts - 1);
    }
    return points;
}

double allowed_error(const RecordTask& task) {
    double allowed = drive::whole_record_error_bound(task.weights, task.record);
    for (const double weight : task.weights) {
        allowed += 0x1p-53 * signal_peak * std::fabs(weight);
    }
    return allowed;
}

void judge(RecordWay& way, std::string_view signal, std::span<const double> exact_errors, double peak, double limit) {
    double error = 0.0;
    for (const double one : exact_errors) {
        error = std::isnan(one) ? INFINITY : std::max(error, std::fabs(one));
    }
    way.error_max = std::max(way.error_max, error / peak);
    if (way.full_memory && !(error <= limit)) {
        way.fault = fmt::format("{}: wrong answer: error {:.3g} beyond {:.3g}", signal, error, limit);
    }
}

Json to_row(double order, const RecordSize& size, const RecordWay& way) {
    RowKey key;
    key.kind = RowKind::record;
    key.kernel = way.name;
    key.order = fmt::format("{}", order);
    key.samples = std::to_string(size.samples);
    key.aspect = RowKey::host;
    Row row(key, size.samples);
    const auto samples = static_cast<double>(size.samples);
    row.set_text("label", way.label);
    row.set(Counter::real_time, 1e9 * way.wall_s() / samples);
    row.set(Counter::cpu_time, 1e9 * way.processor_s() / samples);
    row.set(Counter::ns_per_sample, 1e9 * way.processor_s() / samples);
    row.set(Counter::record_ms, 1e3 * way.processor_s());
    row.set(Counter::turns, way.turns.size());
    row.set(Counter::times_peer, ratio(way, size.way("peer_fftw_f64")));
    row.set(Counter::times_measured_peer, ratio(way, size.way("peer_fftwmeasured_f64")));
    row.set(Counter::error_max, way.error_max);
    row.set(Counter::sums_compared, compared_samples(size.samples).size());
    if (!way.fault.empty()) {
        row.mark_error(way.fault);
    }
    return std::move(row).take();
}

std::string to_table(double order, const std::vector<RecordSize>& sizes) {
    std::string text =
        fmt::format("\nOrder {}\n  {:>8}  {:<22} {:>11} {:>11} {:>10} {:>13} {:>12} {:>10}\n", order, "samples", "how",
                    "ms a record", "ns a sample", "times peer", "times measured", "of size before", "error max");
    for (std::size_t s = 0; s < sizes.size(); ++s) {
        for (const RecordWay& way : sizes[s].ways) {
            const std::string growth = s == 0 ? "-" : fmt::format("{:.1f}", ratio(way, sizes[s - 1].way(way.name)));
            text += fmt::format(
                "  {:>8}  {:<22} {:>11.3f} {:>11.1f} {:>10.2f} {:>14.2f} {:>14} {:>10.1e}{}\n", sizes[s].samples,
                way.name, 1e3 * way.processor_s(), 1e9 * way.processor_s() / static_cast<double>(sizes[s].samples),
                ratio(way, sizes[s].way("peer_fftw_f64")), ratio(way, sizes[s].way("peer_fftwmeasured_f64")), growth,
                way.error_max, way.fault.empty() ? "" : fmt::format("  WRONG: {}", way.fault));
        }
    }
    return text;
}

}  // namespace bench
