#include "cli/help_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace cli {
namespace {

constexpr std::size_t columns = 110;
constexpr std::size_t text_begins = 30;

// `text` from the column where it begins on, broken between words.
std::string wrapped(const std::string& text) {
    std::string page;
    std::size_t at = text_begins;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (at > text_begins && at + 1 + word.size() > columns) {
            page += '\n' + std::string(text_begins, ' ');
            at = text_begins;
        }
        const bool first = at == text_begins;
        page += first ? word : ' ' + word;
        at += word.size() + (first ? 0 : 1);
    }
    return page;
}

std::string row(const std::string& name, const std::string& text) {
    std::string line = "  " + name;
    if (text.empty()) {
        return line + '\n';
    }
    if (line.size() + 1 > text_begins) {
        line += '\n';
        line += std::string(text_begins, ' ');
    } else {
        line.resize(text_begins, ' ');
    }
    return line + wrapped(text) + '\n';
}

std::string row_of(const CLI::Option& option, bool positional) {
    std::string name = option.get_name(positional, !positional);
    if (option.get_type_size() != 0) {
        std::string type = option.get_type_name();
        std::replace(type.begin(), type.end(), ':', ' ');  // FLOAT:above 0
        name += type.empty() ? "" : ' ' + type;
        name += option.get_default_str().empty() ? "" : '=' + option.get_default_str();
        name += option.get_expected_max() > 2 ? " ..." : "";
    }
    name += option.get_required() ? " REQUIRED" : "";
    for (const CLI::Option* other : option.get_needs()) {
        name += " Needs: " + other->get_name();
    }
    return row(name, option.get_description());
}

std::string group(const std::string& title, const std::string& rows) {
    return rows.empty() ? "" : '\n' + title + ":\n" + rows;
}

}  // namespace

std::string HelpPage::make_help(const CLI::App* command, std::string name, CLI::AppFormatMode) const {
    std::string usage = "Usage: " + name + " [OPTIONS]";
    std::string positionals;
    std::string options;
    for (const CLI::Option* option :
         command->get_options([](const CLI::Option* any) { return !any->get_group().empty(); })) {
        if (option->get_positional()) {
            const std::string word = option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
            usage += option->get_required() ? ' ' + word : " [" + word + ']';
            positionals += row_of(*option, true);
        }
        if (option->nonpositional()) {
            options += row_of(*option, false);
        }
    }
    std::string subcommands;
    for (const CLI::App* subcommand : command->get_subcommands([](const CLI::App*) { return true; })) {
        subcommands += row(subcommand->get_name(), subcommand->get_description());
    }
    usage += subcommands.empty() ? "" : " [SUBCOMMAND]";
    const std::string footer = command->get_footer();
    return command->get_description() + '\n' + usage + '\n' + group("Positionals", positionals) +
           group("Options", options) + group("Subcommands", subcommands) + (footer.empty() ? "" : '\n' + footer + '\n');
}

}  // namespace cli
