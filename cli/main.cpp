#include <fmt/format.h>

#include <cctype>
#include <cstdio>
#include <exception>
#include <string_view>

#include "base/failure.hpp"
#include "cli/command.hpp"

namespace {

bool is_negative_number(const std::string& word) {
    return word.size() > 1 && word[0] == '-' &&
           (std::isdigit(static_cast<unsigned char>(word[1])) != 0 || word[1] == '.');
}

// The words as CLI11 wants them: last first, `--orders -0.5` as `--orders=-0.5` (it takes -0 for an option), and
// without Google Benchmark's flags.
std::vector<std::string> prepare_words(int argc, char** argv, std::vector<std::string>& passed_on) {
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.starts_with("--benchmark_") || word.starts_with("--v=")) {
            passed_on.push_back(word);
        } else if (is_negative_number(word) && !words.empty() && words.back().starts_with("--")) {
            words.back() += "=" + word;
        } else {
            words.push_back(word);
        }
    }
    return {words.rbegin(), words.rend()};
}

}  // namespace

int main(int argc, char** argv) {
    const std::string name = fmt::format("glsum {}", cli::command_name);
    cli::Command command(cli::command_summary, name);
    cli::Words words{name, {}};
    for (int i = 1; i < argc; ++i) {
        if (std::string_view(argv[i]) == "--jobs" && i + 1 < argc) {
            ++i;  // decides nothing that is worth a record
            continue;
        }
        words.line += ' ';
        words.line += argv[i];
    }
    cli::add_options(command, words);
    if (argc == 2 && std::string_view(argv[1]) == "--list-options") {  // cli/help.sh, for shells and the manual
        fmt::print("{}", command.rows_of_options(cli::command_name));
        return 0;
    }
    // The launcher tells every command how many jobs may run at once.
    unsigned unused_jobs = 1;
    if (!command.has_option("--jobs")) {
        command.add_option("--jobs", unused_jobs, "").at_least(1).hidden();
    }
    try {
        return command.parse(prepare_words(argc, argv, words.passed_on));
    } catch (const glsum::Failure& failure) {
        fmt::print(stderr, "glsum: {}\n", failure.what());
        return static_cast<int>(failure.status());
    } catch (const std::exception& error) {
        fmt::print(stderr, "glsum: {}\n", error.what());
        return static_cast<int>(glsum::Exit::check_failed);
    }
}
