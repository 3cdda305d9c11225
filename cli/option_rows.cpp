#include "cli/option_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cli {
namespace {

// "TEXT:{a,b}" -> "a,b"
std::string words_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t from = type.find('{');
    const std::size_t to = type.find('}', from);
    return to == std::string::npos ? "" : type.substr(from + 1, to - from - 1);
}

std::string follows(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) {
        return "";
    }
    const std::string type = option.get_type_name();
    const bool is_number = type.starts_with("FLOAT") || type.starts_with("INT") || type.starts_with("UINT");
    return !words_of(option).empty() ? "words" : is_number ? "number" : "text";
}

// Its first sentence: what stands behind a semicolon is for who reads the page.
std::string in_short(std::string text) {
    text.erase(std::min({text.size(), text.find(';'), text.find(". ")}));
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace

std::string option_rows(const CLI::App& app, const std::string& command) {
    std::string rows;
    for (const CLI::Option* option :
         app.get_options([](const CLI::Option* any) { return !any->get_group().empty(); })) {
        const auto row = [&](const std::string& dashes, const std::string& name) {
            rows += fmt::format("{}\t{}{}\t{}\t{}\t{}\n", command, dashes, name, follows(*option), words_of(*option),
                                in_short(option->get_description()));
        };
        for (const std::string& name : option->get_snames()) {
            row("-", name);
        }
        for (const std::string& name : option->get_lnames()) {
            row("--", name);
        }
    }
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
        rows += fmt::format("{}\t{}\tsubcommand\t\t{}\n", command, sub->get_name(), in_short(sub->get_description()));
        rows += option_rows(*sub, command + ' ' + sub->get_name());
    }
    return rows;
}

}  // namespace cli
