// glsum choose: the cheapest kernel, length and format within a budget.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <sstream>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/choose/brute_force.hpp"
#include "bench/choose/report.hpp"
#include "bench/choose/side_by_side.hpp"
#include "cli/board.hpp"
#include "cli/budget.hpp"
#include "cli/command.hpp"
#include "cli/output.hpp"
#include "qemu/emulate/foreign_program.hpp"

namespace cli {
namespace {

// "m7,m4": each of them.
std::vector<std::string> words_of(const std::string& list) {
    std::vector<std::string> words;
    std::istringstream rest(list);
    for (std::string word; std::getline(rest, word, ',');) {
        words.push_back(word);
    }
    return words;
}

struct Check {
    std::size_t budgets = 0;
    std::uint64_t seed = 1;
};

// Every length is counted: a short record unless another was asked for.
void check(Budget budget, const Check& check) {
    if (base::machine_called(budget.target) == nullptr) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             "--check-against-brute-force: only with --target m7 or m4, whose counts repeat");
    }
    budget.samples = budget.samples != 0 ? budget.samples : 100;
    budget.max_error = 1.0;
    const choose::Question question = to_question(budget);
    const choose::Agreement found =
        choose::check_against_brute_force(question, *board_for(question), check.budgets, check.seed);
    fmt::print(
        "{}{} of {} random budgets: the same choice as a plain loop over {} measured candidates ({} kernels, every "
        "length to {})\n{} of them fit nothing; in {} of these no limit need be relaxed less than the nearest miss "
        "says\n",
        found.differences, found.same, found.budgets, found.candidates, question.kernels.size(),
        question.conditions.samples, found.nothing, found.same_miss);
    if (found.same != found.budgets) {
        throw glsum::Failure(glsum::Exit::check_failed, "the search and the loop differ");
    }
}

void run(const Budget& budget, const Output& json) {
    if (budget.max_error == 0.0 && budget.derivative_error.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input, "--max-error or --derivative-error is required");
    }
    const choose::Question question = to_question(budget);
    json.check();
    const choose::Answer answer = choose::answer(question, board_for(question));
    fmt::print("{}", choose::to_table(answer, isatty(STDOUT_FILENO) == 1));
    if (json.wanted()) {
        json.write(choose::to_json(answer).dump(2) + "\n");
    }
    if (answer.choice.chosen) {
        plot_if_asked(budget, answer);
    } else {
        throw glsum::Failure(glsum::Exit::check_failed, choose::nearest_miss(answer));
    }
}

// Several machines, each with its own answer, then what was chosen for one on the others.
void run_side_by_side(const Budget& budget, const std::vector<std::string>& targets, const Output& json) {
    const auto refuse = [](const std::string& what) { throw glsum::Failure(glsum::Exit::bad_input, what); };
    if (budget.max_error == 0.0 && budget.derivative_error.empty()) {
        refuse("--max-error or --derivative-error is required");
    }
    if (budget.clock_hz || budget.rate_hz || budget.max_instructions || !budget.plot.empty()) {
        refuse(
            "--clock-hz, --rate-hz, --max-instructions, --plot: expected one --target; several have the clocks of "
            "their core files");
    }
    std::vector<choose::Question> questions;
    for (const std::string& target : targets) {
        const base::Machine* const machine = base::machine_called(target);
        if (machine == nullptr) {
            refuse(fmt::format("--target: expected, of several, {}, found {}",
                               fmt::join(base::machine_words(), " and "), target));
        }
        Budget own = budget;
        own.target = target;
        own.core.clear();
        for (const std::string& core : words_of(budget.core)) {
            if (&qemu::machine_of({core, "", ""}, cores_folder()) == machine) {
                own.core = core;
            }
        }
        questions.push_back(to_question(own));
    }
    json.check();
    std::vector<choose::Answer> answers;
    std::vector<qemu::Board> boards;
    for (const choose::Question& question : questions) {
        boards.push_back(built_board(*choose::machine_of(question.target)));
        answers.push_back(choose::answer(question, boards.back()));
        fmt::print("{}\n", choose::to_table(answers.back(), isatty(STDOUT_FILENO) == 1));
    }
    const std::vector<choose::OnMachine> rows = choose::side_by_side(answers, boards);
    fmt::print("{}", choose::to_table(rows, answers));
    if (json.wanted()) {
        json.write(choose::to_json(rows, answers).dump(2) + "\n");
    }
    if (rows.empty()) {
        throw glsum::Failure(glsum::Exit::check_failed, "nothing fits on any of them");
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto budget = add_budget(command);
    auto json = std::make_shared<Output>();
    for (const char* needed : {"--step-s", "--target"}) {
        command.option(needed).required();
    }
    json->add_to(command, "--json", "The answer");
    auto against = std::make_shared<Check>();
    command
        .add_option("--check-against-brute-force", against->budgets,
                    "Draws so many budgets and compares the search with a plain loop over every kernel and length")
        .at_least(1);
    command.add_option("--seed", against->seed, "Of the budgets drawn").at_least(0).capture_default_str();
    command.footer(
        "Records are sampled at --step-s: sines and the drive's response are the same signals at other instants; "
        "step,\n"
        "ramp (from 0 to 0.9 over the record) and noise have no time of their own. Sines that --step-s cannot show "
        "are\n"
        "left out. Result files are of h = 1 ms and serve only there.\n"
        "--derivative-error speaks of the derivative that is meant, not of the sum: each length is a filter of its "
        "own,\n"
        "fitted to the band and the step, judged as the kernel holds it, its noise included.\n"
        "Exit status: 0 something fits; 1 nothing does, with the nearest miss; 2 wrong use; 3 something is missing.\n"
        "Example: glsum choose --order 0.5 --step-s 0.001 --max-error 0.05 --target m7 --clock-hz 216e6 --rate-hz "
        "1000\n"
        "         glsum choose --order 0.5 --step-s 0.001 --derivative-error 5% --band 0.05..80 --step-until 60 "
        "--target "
        "m7\n"
        "         glsum choose --order 0.5 --step-s 0.001 --max-error 0.01 --target m7,m4");
    command.callback([budget, json, against] {
        const std::vector<std::string> targets = words_of(budget->target);
        if (against->budgets > 0) {
            check(*budget, *against);
        } else if (targets.size() > 1) {
            run_side_by_side(*budget, targets, *json);
        } else {
            run(*budget, *json);
        }
    });
}

}  // namespace cli
