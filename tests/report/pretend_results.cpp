#include "tests/report/pretend_results.hpp"

#include <cmath>
#include <iterator>
#include <random>

#include "bench/sweep/signals.hpp"
#include "bench/sweep/sweep.hpp"
#include "glsum/catalogue.hpp"

namespace test {
namespace {

constexpr std::size_t kernels = 40;  // the registry's first
constexpr double orders[] = {0.2, 0.3, 0.5, 0.7, 0.9, 0.98319, 1.5, 1.9909, -0.5};

}  // namespace

bench::Results pretend_results(std::size_t rows, std::uint64_t seed) {
    bench::Results results;
    results.context["n_samples"] = 5000;
    results.context["seed"] = 2020;
    results.context["compiler"] = "none: pretended";
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> noise(0.5, 1.5);
    for (std::size_t taps = 50; results.rows.size() < rows; taps = taps * 5 / 4) {
        const bench::Length length{taps};
        for (const double order : orders) {
            std::size_t number = 0;
            for (const glsum::CatalogueEntry& entry : glsum::catalogue) {
                if (!entry.format.empty() && !entry.host_only && number++ < kernels) {
                    const std::string kernel(entry.name);
                    const auto at = static_cast<double>(taps);
                    const double truncation = std::pow(at, -1.0 - order);
                    for (const std::string_view signal : bench::signal_names) {
                        bench::RowKey key = bench::row_key(kernel, order, length, bench::RowKey::accuracy);
                        key.signal = signal;
                        auto& row = results.rows.emplace_back(bench::make_row(to_name(key), 5000));
                        row["rounding_error_max"] = 1e-6 * noise(random);
                        row["truncation_error_max"] = truncation * noise(random);
                        row["error_max"] = truncation * noise(random) + 1e-6;
                        row["error_rms"] = truncation * noise(random) / 3.0;
                        row["effective_taps"] = entry.floating_point ? taps : std::min<std::size_t>(taps, 300);
                        row["macs_per_sample"] = taps - 1;
                        row["coefficient_bytes"] = 4 * taps;
                        row["state_bytes"] = 4 * taps + 24;
                    }
                    auto& counted = results.rows.emplace_back(
                        bench::make_row(to_name(bench::row_key(kernel, order, length, "m7:pretend")), 32));
                    const double instructions = std::round(5.0 * at * noise(random));
                    const double load_use = at;
                    const double fpu_latency = std::round(2.0 * at * noise(random));
                    const double cycles = instructions / 2.0 + load_use + fpu_latency;
                    counted["instructions_per_sample"] = instructions;
                    counted["worst_instructions"] = instructions + 1.0;
                    counted["code_bytes"] = 120;
                    counted["stack_bytes"] = 40;
                    counted["model_cycles_per_sample"] = cycles;
                    counted["model_cycles_low"] = 0.97 * cycles;
                    counted["model_cycles_high"] = 1.04 * cycles;
                    counted["stall_load_use"] = load_use;
                    counted["stall_fpu_latency"] = fpu_latency;
                }
            }
        }
        for (const char* kernel :
             {"shift_plain_f64", "ring_plain_f32", "ring_plain_q31", "ring_plain_q15", "ring_plain_f32a64"}) {
            auto& timed = results.rows.emplace_back(
                bench::make_row(to_name(bench::row_key(kernel, orders[0], length, "host")), 1000));
            timed["real_time"] = static_cast<double>(taps) * noise(random);
            timed["cycles_per_sample"] = timed["real_time"].get<double>() * 2.5;
        }
    }
    results.rows.resize(std::max(rows, std::size_t{1}));
    return results;
}

}  // namespace test
