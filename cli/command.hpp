// One program a command: main parses and reports, this is what each program's own file gives to it.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "cli/command_name.hpp"

// CLI11 parses, behind this page: each file that includes it takes three seconds longer to compile.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace cli {

/// An option of a command; what is set is returned, to be set further.
class Option {
public:
    explicit Option(CLI::Option* option) : option_(option) {}
    Option& required();
    Option& delimiter(char between);        ///< of the words of a list
    Option& expected(int least, int most);  ///< words
    Option& needs(const Option& other);
    Option& each(std::function<void(const std::string&)> take);  ///< of its words, as they are parsed
    // What its numbers may be, which the help says, and the error to any other word.
    Option& above(double bound);
    Option& at_least(double lowest);
    Option& between(double lowest, double highest);
    Option& within(double above, double highest);
    Option& one_of(std::initializer_list<std::string> words);
    Option& type_name(const std::string& name);  ///< in the help
    Option& capture_default_str();               ///< the help tells what the target now holds
    Option& default_str(const std::string& text);
    Option& hidden();
    /// Whether it was given.
    [[nodiscard]] bool given() const;

private:
    CLI::Option* option_;
};

class Command {
public:
    Command(const std::string& summary, const std::string& name);
    explicit Command(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

    /// `names`: "--model", "--base-order,--q", or "A" for a word without one. `target` outlives the run. Of the types
    /// that command.cpp lists.
    template <class Target>
    Option add_option(const std::string& names, Target& target, const std::string& help);
    Option add_flag(const std::string& names, bool& target, const std::string& help);
    /// A flag that is taken and says nothing.
    Option add_flag(const std::string& names);
    /// One that was added.
    Option option(const std::string& name);
    [[nodiscard]] bool has_option(const std::string& name) const;
    void footer(const std::string& text);
    void callback(std::function<void()> run);
    /// Runs once the words are parsed, before the callback; several in turn.
    void prepare(std::function<void()> act);

    Command add_subcommand(const std::string& name, const std::string& summary);
    void takes_one_subcommand();  ///< or none
    [[nodiscard]] bool given_subcommand() const;

    /// Of the command and its subcommands, as `option_rows` has them.
    [[nodiscard]] std::string rows_of_options(const std::string& name) const;

    /// Parses and runs. \param words  the last first
    /// \return 0, or where they are not as expected, which it then prints, the exit status of bad input
    int parse(std::vector<std::string> words);

private:
    std::shared_ptr<CLI::App> app_;
    std::shared_ptr<std::vector<std::function<void()>>> preparations_ =
        std::make_shared<std::vector<std::function<void()>>>();
};

/// What the user typed, for commands that want it as it was.
struct Words {
    std::string line;                    ///< the whole command but --jobs, for the record
    std::vector<std::string> passed_on;  ///< Google Benchmark's own flags, unread
};

/// Adds options, examples and what runs them. Each program defines it once. \param words  outlives the run
void add_options(Command& command, const Words& words);

}  // namespace cli
