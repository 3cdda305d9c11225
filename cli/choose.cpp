// glsum choose: the cheapest kernel, length and format within a budget.
#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <optional>

#include "bench/choose/report.hpp"
#include "bench/files.hpp"
#include "cli/board.hpp"
#include "cli/budget.hpp"
#include "cli/commands.hpp"
#include "qemu/failure.hpp"

namespace cli {
namespace {

void run(const Budget& budget, const std::string& json) {
    const choose::Question question = to_question(budget);
    if (!json.empty()) {
        bench::check_writable(json);
    }
    const choose::Answer answer = choose::answer(question, board_for(question));
    fmt::print("{}", choose::to_table(answer, isatty(STDOUT_FILENO) == 1));
    if (!json.empty()) {
        bench::write_file(json, choose::to_json(answer).dump(2) + "\n");
    }
    if (!answer.choice.chosen) {
        throw glsum::Failure(glsum::Exit::check_failed, choose::nearest_miss(answer));
    }
}

}  // namespace

void add_choose(CLI::App& app) {
    CLI::App* command = app.add_subcommand("choose", "The cheapest kernel, length and format within a budget");
    auto budget = add_budget(*command);
    auto json = std::make_shared<std::string>();
    for (const char* needed : {"--step-s", "--max-error", "--target"}) {
        command->get_option(needed)->required();
    }
    command->add_option("--json", *json, "Writes the answer there too");
    command->footer(
        "Records are sampled at --step-s: sines and the drive's response are the same signals at other instants; "
        "step,\n"
        "ramp (from 0 to 0.9 over the record) and noise have no time of their own. Sines that --step-s cannot show "
        "are\n"
        "left out. Result files are of h = 1 ms and serve only there.\n"
        "Exit status: 0 something fits; 1 nothing does, with the nearest miss; 2 wrong use; 3 something is missing.\n"
        "Example: glsum choose --order 0.5 --step-s 0.001 --max-error 0.05 --target m7 --clock-hz 216e6 --rate-hz "
        "1000");
    command->callback([budget, json] { run(*budget, *json); });
}

}  // namespace cli
