// What a command says to --help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace cli {

/// A page of at most 110 columns. CLI11's own pages change with its releases; the launcher shows ours before anything
/// is built.
class HelpPage : public CLI::FormatterBase {
public:
    std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace cli
