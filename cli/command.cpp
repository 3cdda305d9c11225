#include "cli/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>

#include "base/failure.hpp"
#include "cli/help_page.hpp"
#include "cli/option_rows.hpp"

namespace cli {
namespace {

void check(CLI::Option& option, const std::string& range, const std::function<bool(double)>& holds) {
    option.check(CLI::Validator(
        [range, holds](const std::string& word) {
            double value = std::nan("");
            const bool is_number = CLI::detail::lexical_cast(word, value) && std::isfinite(value);
            return is_number && holds(value) ? std::string()
                                             : fmt::format("expected a number {}, found {}", range, word);
        },
        range));
}

// `indices --json log.csv`: where words may stand alone, one behind --json is its FILE only if it ends so. \param words
// the last first
void part_from_words(const CLI::App& app, std::vector<std::string>& words) {
    const auto options = app.get_options();
    if (std::none_of(options.begin(), options.end(), [](const CLI::Option* one) { return one->get_positional(); })) {
        return;
    }
    for (std::size_t i = words.size(); i-- > 1;) {
        const std::string& next = words[i - 1];
        if (words[i] == "--json" && !next.ends_with(".json") && next != "-" &&
            app.get_option_no_throw("--json") != nullptr) {
            words.insert(words.begin() + static_cast<std::ptrdiff_t>(i), "-");
        }
    }
}

}  // namespace

Option& Option::required() { return option_->required(), *this; }
Option& Option::delimiter(char between) { return option_->delimiter(between), *this; }
Option& Option::expected(int least, int most) { return option_->expected(least, most), *this; }
Option& Option::needs(const Option& other) { return option_->needs(other.option_), *this; }
Option& Option::each(std::function<void(const std::string&)> take) { return option_->each(take), *this; }
Option& Option::above(double bound) {
    check(*option_, fmt::format("above {}", bound), [bound](double value) { return value > bound; });
    return *this;
}
Option& Option::at_least(double lowest) {
    check(*option_, fmt::format("of at least {}", lowest), [lowest](double value) { return value >= lowest; });
    return *this;
}
Option& Option::between(double lowest, double highest) {
    check(*option_, fmt::format("from {} to {}", lowest, highest),
          [lowest, highest](double value) { return value >= lowest && value <= highest; });
    return *this;
}
Option& Option::within(double above, double highest) {
    check(*option_, fmt::format("in ({}, {}]", above, highest),
          [above, highest](double value) { return value > above && value <= highest; });
    return *this;
}
Option& Option::one_of(std::initializer_list<std::string> words) {
    return option_->check(CLI::IsMember(std::vector<std::string>(words))), *this;
}
Option& Option::type_name(const std::string& name) { return option_->type_name(name), *this; }
Option& Option::capture_default_str() { return option_->capture_default_str(), *this; }
Option& Option::default_str(const std::string& text) { return option_->default_str(text), *this; }
Option& Option::hidden() { return option_->group(""), *this; }
bool Option::given() const { return option_->count() > 0; }

Command::Command(const std::string& summary, const std::string& name)
    : app_(std::make_shared<CLI::App>(summary, name)) {
    app_->formatter(std::make_shared<HelpPage>());  // subcommands inherit it
}

template <class Target>
Option Command::add_option(const std::string& names, Target& target, const std::string& help) {
    return Option(app_->add_option(names, target, help));
}
template Option Command::add_option(const std::string&, int&, const std::string&);
template Option Command::add_option(const std::string&, unsigned&, const std::string&);
template Option Command::add_option(const std::string&, std::size_t&, const std::string&);
template Option Command::add_option(const std::string&, double&, const std::string&);
template Option Command::add_option(const std::string&, std::string&, const std::string&);
template Option Command::add_option(const std::string&, std::filesystem::path&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<unsigned>&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<std::size_t>&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<std::string>&, const std::string&);
template Option Command::add_option(const std::string&, std::vector<double>&, const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::filesystem::path>&, const std::string&);

Option Command::add_flag(const std::string& names, bool& target, const std::string& help) {
    return Option(app_->add_flag(names, target, help));
}
Option Command::add_flag(const std::string& names) { return Option(app_->add_flag(names)); }
Option Command::option(const std::string& name) { return Option(app_->get_option(name)); }
bool Command::has_option(const std::string& name) const { return app_->get_option_no_throw(name) != nullptr; }
void Command::footer(const std::string& text) { app_->footer(text); }
void Command::callback(std::function<void()> run) { app_->callback(std::move(run)); }
void Command::prepare(std::function<void()> act) {
    preparations_->push_back(std::move(act));
    app_->parse_complete_callback([all = preparations_] {
        for (const auto& one : *all) {
            one();
        }
    });
}

Command Command::add_subcommand(const std::string& name, const std::string& summary) {
    return Command(std::shared_ptr<CLI::App>(app_, app_->add_subcommand(name, summary)));
}
void Command::takes_one_subcommand() { app_->require_subcommand(0, 1); }
bool Command::given_subcommand() const { return !app_->get_subcommands().empty(); }

std::string Command::rows_of_options(const std::string& name) const { return option_rows(*app_, name); }

int Command::parse(std::vector<std::string> words) {
    part_from_words(*app_, words);
    try {
        app_->parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        return app_->exit(error) == 0 ? 0 : static_cast<int>(glsum::Exit::bad_input);
    }
    return 0;
}

}  // namespace cli
