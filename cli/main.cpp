#include <fmt/format.h>

#include <cctype>
#include <cstdio>
#include <exception>

#include "bench/build_info.hpp"
#include "cli/commands.hpp"
#include "cli/score.hpp"
#include "qemu/failure.hpp"

namespace {

bool is_negative_number(const std::string& word) {
    return word.size() > 1 && word[0] == '-' &&
           (std::isdigit(static_cast<unsigned char>(word[1])) != 0 || word[1] == '.');
}

// The words as CLI11 wants them: last first, `--orders -0.5` as `--orders=-0.5` (it takes -0 for an option), and
// without Google Benchmark's flags.
std::vector<std::string> prepare_words(int argc, char** argv, cli::PassedOn& passed_on) {
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
    CLI::App app("Embedded performance benchmark suite for the Grünwald-Letnikov fractional sum", "glsum");
    app.set_version_flag("--version", build_info::version);
    app.require_subcommand(1);
    cli::PassedOn passed_on;
    std::string command_line = "glsum";
    for (int i = 1; i < argc; ++i) {
        command_line += ' ';
        command_line += argv[i];
    }
    cli::add_bench(app, passed_on);
    cli::add_merge(app);
    cli::add_report(app);
    cli::add_choose(app);
    cli::add_generate(app, command_line);
    cli::add_gate(app);
    cli::add_compare(app);
    cli::add_time(app);
    cli::add_silicon(app);
    cli::add_simulate(app);
    cli::add_identify(app);
    cli::add_stability(app);
    cli::add_indices(app);
    cli::add_resample(app);
    cli::add_score(app);
    cli::add_stand(app);
    cli::add_paper(app);
    cli::add_diagnose(app);
    // The launcher tells every command how many jobs may run at once.
    unsigned unused_jobs = 1;
    for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
        if (command->get_option_no_throw("--jobs") == nullptr) {
            command->add_option("--jobs", unused_jobs, "Threads at once; this command needs one only")
                ->check(CLI::PositiveNumber);
        }
    }
    try {
        if (argc > 1 && argv[1][0] != '-' &&
            app.get_subcommands([&](const CLI::App* command) { return command->get_name() == argv[1]; }).empty()) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("{}: no such command; --help lists them", argv[1]));
        }
        app.parse(prepare_words(argc, argv, passed_on));
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(glsum::Exit::bad_input);
    } catch (const glsum::Failure& failure) {
        fmt::print(stderr, "glsum: {}\n", failure.what());
        return static_cast<int>(failure.status());
    } catch (const std::exception& error) {
        fmt::print(stderr, "glsum: {}\n", error.what());
        return static_cast<int>(glsum::Exit::check_failed);
    }
    return 0;
}
