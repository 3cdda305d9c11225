#include "bench/sweep/truncation_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "base/parallel.hpp"
#include "bench/rows/key.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/weights.hpp"

namespace bench {
namespace {

constexpr std::size_t most_samples = 20'000;
constexpr std::size_t most_cases = 1'000;

template <class T>
std::optional<T> to_number(const std::string& text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// An order and signal whose record can be made again, and the lengths that it was measured at.
struct Case {
    std::string order;
    std::string signal;
    std::set<std::size_t> lengths;
    std::vector<double> bounds;
};

// In the order of order/signal.
std::vector<Case> cases_of(const std::vector<Json>& rows) {
    std::map<std::string, Case> by_key;
    for (const Json& row : rows) {
        const auto key = parse_key(row.value("name", ""));
        if (!key || !key->is_accuracy() || !key->amplitude.empty() ||
            std::find(std::begin(signal_names), std::end(signal_names), key->signal) == std::end(signal_names)) {
            continue;
        }
        const auto taps = to_number<std::size_t>(key->taps);
        const auto order = to_number<double>(key->order);
        if (taps && order && glsum::order_in_range(*order)) {
            Case& found = by_key[key->order + '/' + key->signal];
            found.order = key->order;
            found.signal = key->signal;
            found.lengths.insert(*taps);
        }
    }
    std::vector<Case> cases;
    for (auto& [key, found] : by_key) {
        cases.push_back(std::move(found));
    }
    return cases;
}

}  // namespace

double dropped_sum(double order, std::size_t taps, std::size_t samples) {
    // Only what is dropped is summed: as the difference of two whole sums it would drown in their rounding.
    double sum = taps == 0 && samples > 0 ? 1.0 : 0.0;
    glsum::Weights weights(order);
    for (std::size_t j = 1; j < samples; ++j) {
        weights.next();
        sum += j >= taps ? std::fabs(weights.weight()) : 0.0;
    }
    return sum;
}

double largest_sum(double order, std::span<const double> record) {
    std::vector<double> sums(record.begin(), record.end());
    glsum::Weights weights(order);
    for (std::size_t j = 1; j < record.size(); ++j) {  // one coefficient at a time: independent sums, which vectorise
        weights.next();
        const double a = weights.weight();
        for (std::size_t k = j; k < record.size(); ++k) {
            sums[k] += a * record[k - j];
        }
    }
    double largest = 0.0;
    for (const double sum : sums) {
        largest = std::max(largest, std::fabs(sum));
    }
    return largest;
}

std::vector<double> truncation_bounds(double order, std::string_view signal, std::span<const std::size_t> lengths,
                                      std::size_t samples, std::uint64_t seed) {
    const std::vector<double> record = make_signal(signal, samples, seed);
    double peak = 0.0;
    for (const double x : record) {
        peak = std::max(peak, std::fabs(x));
    }
    const double scale = (1.0 + 1e-9) * peak / largest_sum(order, record);
    std::vector<double> bounds;
    for (const std::size_t taps : lengths) {
        bounds.push_back(scale * dropped_sum(order, taps, samples));
    }
    return bounds;
}

TruncationBounds truncation_bounds(const Json& context, const std::vector<Json>& rows, unsigned jobs) {
    TruncationBounds bounds;
    const auto weights = context.find("weights");
    if (weights != context.end() && *weights != "gl" && *weights != "shifted") {
        bounds.missing = fmt::format("bounds are of Grünwald-Letnikov's weights, not of {}", weights->dump());
        return bounds;
    }
    const auto samples = context.find("n_samples");
    const auto seed = context.find("seed");
    // From memory an integer may be signed, from a file it is not.
    const auto is_count = [&](auto found) {
        return found != context.end() && found->is_number_integer() && *found >= 0;
    };
    if (!is_count(samples) || !is_count(seed)) {
        bounds.missing = "the context has no n_samples and seed, so the records cannot be made again";
        return bounds;
    }
    if (*samples < 2 || *samples > most_samples) {
        bounds.missing =
            fmt::format("records of {} samples; bounds are made for up to {}", samples->dump(), most_samples);
        return bounds;
    }
    std::vector<Case> cases = cases_of(rows);
    if (cases.size() > most_cases) {
        bounds.missing =
            fmt::format("{} pairs of order and signal; bounds are made for up to {}", cases.size(), most_cases);
        return bounds;
    }
    base::parallel_for(cases.size(), jobs, [&](std::size_t i) {
        const std::vector<std::size_t> lengths(cases[i].lengths.begin(), cases[i].lengths.end());
        cases[i].bounds = truncation_bounds(*to_number<double>(cases[i].order), cases[i].signal, lengths,
                                            samples->get<std::size_t>(), seed->get<std::uint64_t>());
    });
    for (const Case& found : cases) {
        auto bound = found.bounds.begin();
        for (const std::size_t taps : found.lengths) {
            bounds.of[found.order][found.signal][std::to_string(taps)] = *bound++;
        }
    }
    return bounds;
}

WorstBounds worst_of_signals(const TruncationBounds& bounds) {
    WorstBounds worst;
    for (const auto& [order, by_signal] : bounds.of) {
        for (const auto& [signal, by_taps] : by_signal) {
            for (const auto& [taps, bound] : by_taps) {
                double& largest = worst[order][taps];
                largest = std::max(largest, bound);
            }
        }
    }
    return worst;
}

}  // namespace bench
