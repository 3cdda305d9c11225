#include "cli/checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/machines.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/weights.hpp"

namespace cli {

using glsum::Exit;
using glsum::Failure;

void check_orders(const std::vector<double>& orders) {
    for (const double order : orders) {
        if (!glsum::order_in_range(order)) {
            throw Failure(Exit::bad_input, fmt::format("--orders: expected a number in (-2, 2], found {}", order));
        }
    }
}

void check_signals(const std::vector<std::string>& signals) {
    for (const std::string& signal : signals) {
        if (std::find(std::begin(bench::signal_names), std::end(bench::signal_names), signal) ==
            std::end(bench::signal_names)) {
            throw Failure(Exit::bad_input, fmt::format("--signals: expected some of {}, found {}",
                                                       fmt::join(bench::signal_names, ", "), signal));
        }
    }
}

void check_targets(const std::vector<std::string>& targets) {
    for (const std::string& target : targets) {
        if (target != "host" && base::machine_called(target) == nullptr) {
            throw Failure(Exit::bad_input, fmt::format("--targets: expected some of host, {}, found {}",
                                                       fmt::join(base::machine_words(), ", "), target));
        }
    }
}

std::filesystem::path results_folder() { return std::filesystem::path(build_info::source_folder) / "results"; }

}  // namespace cli
