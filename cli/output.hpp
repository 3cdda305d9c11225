// What a command gives to programs: --json [FILE], in every command with one meaning.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/command.hpp"

namespace cli {

/// With a FILE it goes there, and the text for people to standard output as ever. Without one, or with "-", it alone
/// goes to standard output, and what else is said to standard error.
class Output {
public:
    /// Adds the option. \param name  "--json"; of a word behind it that does not end in .json, in a command whose words
    /// may stand alone, it is not the FILE
    Option add_to(Command& command, const std::string& name, const std::string& help);

    [[nodiscard]] bool wanted() const { return option_ && option_->given(); }
    [[nodiscard]] bool to_stdout() const { return wanted() && (file_.empty() || file_ == "-"); }
    /// Of commands that write either a text or this, and have an --out for it.
    [[nodiscard]] Output or_to(const std::filesystem::path& out) const;
    /// Fails now rather than after a long run.
    void check() const;
    /// \pre wanted() \throws glsum::Failure (bad input) where it cannot be written
    void write(const std::string& text) const;

private:
    std::optional<Option> option_;
    std::string file_;
};

}  // namespace cli
