// What commands that measure ask of the words they are given, and where their files go.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cli {

/// Each throws glsum::Failure (bad input) naming the option, what it expects and what it found.
void check_orders(const std::vector<double>& orders);
void check_signals(const std::vector<std::string>& signals);
void check_targets(const std::vector<std::string>& targets);

/// Where result files go that no option names.
[[nodiscard]] std::filesystem::path results_folder();

}  // namespace cli
