#include <fmt/format.h>

#include <algorithm>

#include "bench/rows/key.hpp"
#include "bench/studies/equal_cost.hpp"
#include "bench/studies/equal_cost_errors.hpp"

namespace bench {
namespace {

// In the order of tables and pictures.
constexpr EqualCostWay ways[] = {
    {"shift_plain_f64", "window"},
    {"mirrorhold_oldest_f64", "window, oldest held"},
    {"mirrorlinear_oldest_f64", "window, line to first"},
    {"mirrordelta_oldest_f64", "window of increments"},
    {"nested_plain_f64", "logarithmic memory"},
    {oustaloup_of_sums, "Oustaloup's filter", true},
    {oustaloup_of_derivative, "... for one derivative", true},
    {"modes_plain_f64", "modes"},
    {"modesdelta_plain_f64", "modes of increments"},
    {"mirror_multi_f64", "full memory"},
};

}  // namespace

std::string key_of(std::string_view way, std::size_t cost, const std::string& order, const std::string& signal) {
    return fmt::format("{}|{}|{}|{}", way, cost, order, signal);
}

EqualCostErrors errors_by_key(const std::vector<Json>& rows, Counter counter) {
    EqualCostErrors found;
    for (const Json& row : rows) {
        const auto key = parse_any_key(row.at("name").get_ref<const std::string&>());
        if (const auto error = value_of(row, counter); error && key && key->amplitude.empty()) {
            found[key_of(row.at("way").get<std::string>(), row.at("cost").get<std::size_t>(), key->order,
                         key->signal)] = *error;
        }
    }
    return found;
}

std::span<const EqualCostWay> equal_cost_ways() { return ways; }

std::string to_table(const EqualCost& wanted, const std::vector<Json>& rows) {
    struct Against {
        Counter counter;
        const char* title;
    };
    constexpr Against all[] = {
        {Counter::error_max, "the exact sum"},
        {Counter::derivative_error_max, "the exact derivative, where the signal has a formula"},
        {Counter::derivative_error_late_max, "the exact derivative, in the second half: the signal's start has faded"},
    };
    std::vector<std::size_t> costs = wanted.costs;
    costs.push_back(wanted.samples - 1);
    std::string text;
    for (const double order : wanted.orders) {
        for (const Against& against : all) {
            const EqualCostErrors found = errors_by_key(rows, against.counter);
            std::vector<std::string> signals = wanted.signals;
            std::erase_if(signals, [&](const std::string& signal) {
                return std::ranges::none_of(found, [&](const auto& error) {
                    return error.first.ends_with(fmt::format("|{}|{}", order, signal));
                });
            });
            if (signals.empty()) {
                continue;
            }
            text +=
                fmt::format("\nOrder {}, against {}\n  {:>15}  {:<24}", order, against.title, "multiplications", "way");
            for (const std::string& signal : signals) {
                text += fmt::format(" {:>8}", signal);
            }
            text += fmt::format(" {:>8}\n", "worst");
            for (const std::size_t cost : costs) {
                for (const EqualCostWay& way : ways) {
                    double worst = 0.0;
                    std::string line;
                    for (const std::string& signal : signals) {
                        const auto error = found.find(key_of(way.name, cost, fmt::format("{}", order), signal));
                        if (error == found.end()) {
                            break;
                        }
                        worst = std::max(worst, error->second);
                        line += fmt::format(" {:>8.1e}", error->second);
                    }
                    if (!line.empty()) {
                        text += fmt::format("  {:>15}  {:<24}{} {:>8.1e}\n", cost, way.label, line, worst);
                    }
                }
            }
        }
    }
    return text;
}

}  // namespace bench
