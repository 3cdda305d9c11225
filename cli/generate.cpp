// glsum generate: a kernel, chosen within a budget or named, as one C99 header.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/choose/derivative_errors.hpp"
#include "bench/choose/derivative_text.hpp"
#include "bench/choose/provenance.hpp"
#include "bench/choose/report.hpp"
#include "bench/generate/header.hpp"
#include "bench/target/target_rows.hpp"
#include "bench/verify/verify.hpp"
#include "cli/board.hpp"
#include "cli/budget.hpp"
#include "cli/command.hpp"
#include "cli/generate_controller.hpp"
#include "cli/generate_model.hpp"
#include "cli/header_options.hpp"
#include "qemu/emulate/foreign_program.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

[[noreturn]] void refuse(const std::string& what) { throw Failure(Exit::bad_input, what); }

choose::Answer choose_one(const Budget& budget) {
    choose::Question question = to_question(budget);
    const std::vector<std::string> possible = generate::generatable();
    std::erase_if(question.kernels, [&](const std::string& kernel) {
        return std::find(possible.begin(), possible.end(), kernel) == possible.end();
    });
    choose::Answer answer = choose::answer(question, board_for(question));
    fmt::print("{}", choose::to_table(answer, isatty(STDOUT_FILENO) == 1));
    if (!answer.choice.chosen) {
        throw Failure(Exit::check_failed, choose::nearest_miss(answer));
    }
    plot_if_asked(budget, answer);
    return answer;
}

void run(const HeaderOptions& options, Budget budget, const std::string& command) {
    const std::string core = core_of(budget);
    const base::Machine& machine = qemu::machine_of({core, "", ""}, cores_folder());  // refused before all else
    if (!options.controller.empty()) {
        if (!options.kernel.empty() || !options.taps.empty() || !budget.derivative_error.empty()) {
            refuse(
                "--controller: expected --out, --plant, --format, --input-scale, --verify, --core, --json, --prefix, "
                "--licence, --max-error and --samples alone beside it");
        }
        if (!budget.core.empty() && !options.verify) {
            refuse("--core: expected --verify beside it and --controller");
        }
        generate_controller(
            {options.controller, options.plant, options.json, options.out, options.prefix, options.licence, core,
             options.verify, budget.max_error, budget.samples, options.format, options.input_scale},
            command);
        return;
    }
    if (!options.model.empty()) {
        if (!options.kernel.empty() || !options.taps.empty() || !budget.derivative_error.empty() ||
            !options.plant.empty()) {
            refuse(
                "--model: expected --out, --step-s, --max-error, --samples, --format, --input-scale, --verify, --core, "
                "--json, --prefix and --licence alone beside it");
        }
        if (!budget.core.empty() && !options.verify) {
            refuse("--core: expected --verify beside it and --model");
        }
        generate_model({options.model, options.json, options.out, options.prefix, options.licence, core, options.verify,
                        budget.max_error, budget.step_s, budget.samples, options.format, options.input_scale},
                       command);
        return;
    }
    if (!options.format.empty() || options.input_scale) {
        refuse(fmt::format("{}: expected --controller or --model beside it; a sum's format is its kernel's",
                           options.format.empty() ? "--input-scale" : "--format"));
    }
    if (!options.plant.empty()) {
        refuse("--plant: expected --controller beside it");
    }
    if (options.json.wanted()) {
        refuse("--json: expected --controller or --model beside it");
    }
    if (std::isnan(budget.order)) {
        refuse("--order is required");
    }
    if (options.out.empty() && !options.verify) {
        refuse("--out: expected a file to write (or --verify alone)");
    }
    if (!options.out.empty()) {
        base::check_writable(options.out);
    }
    std::vector<generate::Spec> specs;
    std::optional<choose::Answer> answer;
    if (options.kernel.empty()) {
        if (budget.step_s == 0.0 || (budget.max_error == 0.0 && budget.derivative_error.empty()) ||
            budget.target.empty() || !options.taps.empty()) {
            refuse(
                "expected a budget (--order, --step-s, --max-error or --derivative-error, --target) or a kernel "
                "(--order, --kernel, --taps)");
        }
        answer = choose_one(budget);
        specs = {to_spec(options, budget, answer->choice.chosen->kernel, answer->choice.chosen->taps)};
        if (answer->derivative) {
            specs.front().fitted = answer->derivative->filter;
            specs.front().fitted_by = choose::text_of(answer->question.by);
            specs.front().use = choose::use_of(*answer->derivative, *answer->question.goal);
        }
    } else {
        if (!budget.derivative_error.empty()) {
            refuse("--derivative-error: it fits a filter to what is chosen; expected no --kernel beside it");
        }
        budget.step_s = budget.step_s == 0.0 ? 0.001 : budget.step_s;
        budget.target = budget.target.empty() ? std::string(machine.word) : budget.target;
        budget.max_error = 1.0;  // no limit: it is measured and told
        const std::vector<std::string> kernels = named_kernels(options.kernel, budget.order);
        if (kernels.size() > 1 && !options.out.empty()) {
            refuse(fmt::format("--kernel: expected one kernel for --out, found {} that match {}", kernels.size(),
                               options.kernel));
        }
        for (const std::string& kernel : kernels) {
            specs.push_back(
                to_spec(options, budget, kernel, to_taps(options.taps, kernel, budget.order, samples_of(budget))));
        }
        if (!options.out.empty()) {
            (void)generate::make_header(specs.front());  // refused before anything is measured
            answer =
                choose::measure_one(to_question(budget), kernels.front(), specs.front().taps, board_if_there(machine));
        }
    }
    if (!options.out.empty()) {
        specs.front().provenance = choose::provenance(*answer, command);
        const std::string header = generate::make_header(specs.front());
        base::write_file(options.out, header);
        const generate::Spec& spec = specs.front();
        fmt::print("{} with {} taps in {}\n", spec.kernel, generate::length_of(spec).text(), options.out);
    }
    if (options.verify) {
        const qemu::Board board = built_board(machine);
        const auto verified = generate::verify_on_target(specs, board, bench::timing_request(cores_folder(), {core}));
        fmt::print("{}", generate::to_table(verified, core, board));
        const auto failed =
            std::count_if(verified.begin(), verified.end(), [](const auto& one) { return !one.good(); });
        if (failed > 0) {
            throw Failure(Exit::check_failed,
                          fmt::format("{} of {} headers differ in their bits or cost more", failed, verified.size()));
        }
    }
}

}  // namespace

void add_options(Command& command, const Words& words) {
    auto budget = add_budget(command, false);
    auto options = std::make_shared<HeaderOptions>();
    command.add_option("--kernel", options->kernel, "This kernel instead of a choice (with --verify: a glob)");
    command.add_option("--taps", options->taps,
                       "Its length, with --kernel: a number, or 2+7 of near taps and modes or blocks");
    command.add_option("--prefix", options->prefix,
                       "Begins every identifier of the header (default: the name of its file)");
    command.add_option("--licence", options->licence,
                       "The licence that the header's comment ends with (default: none is named)");
    command.add_option("--out", options->out, "The header");
    command.add_option("--controller", options->controller,
                       "A controller file instead of a sum: a fractional PID with limits as one header");
    command.add_option("--model", options->model,
                       "A model file instead of a sum: a plant in real time as one header, stepped with the fewest "
                       "multiplications that keep --max-error");
    command.add_option("--plant", options->plant,
                       "With --controller: a model file; the loop is measured beside full memory in double, and its "
                       "margins are told; an unstable one is refused");
    command.add_option(
        "--format", options->format,
        "With --controller or --model: f32 (default), or q31, whose numbers are all fractions of a full scale");
    command.add_option("--input-scale", options->input_scale,
                       "With --format q31: the full scale of set point and measured value, or of a model's input; a "
                       "controller's output has the larger of its limits, a model's what no input within scale leaves");
    options->json.add_to(command, "--json",
                         "What was found: with --controller schema glsum-controller-1, with --model glsum-model-1");
    command.add_flag(
        "--verify", options->verify,
        "Compiles it for the emulated core (--core, --target), runs its self-check there, counts its instructions and "
        "modelled cycles and the kernel's; of a controller, steps it here and there, compares its bits, "
        "and tells its cycles and "
        "bytes beside an integer PID's");
    command.footer(
        "Takes the budget of `choose` (see there), --derivative-error and --band included, and writes what that "
        "chooses, among the kernels that can be "
        "generated\n"
        "(all but the host's vector kernels); or a kernel by name, at h = 1 ms unless --step-s says otherwise.\n"
        "--controller pid.json takes gains, orders, filter, limits and setpoint weight from a file; --max-error then "
        "bounds the weights of its sums (5e-4)\nover --samples (a million).\n"
        "With --plant no header is written for a loop that is unstable: its sums as single precision holds them, the "
        "plant\nbehind hold and dead time.\n"
        "Exit status: 0 written; 1 nothing fits, or --verify failed; 2 wrong use, or an unstable loop; 3 something is "
        "missing.\n"
        "Example: glsum generate --order 0.5 --step-s 0.001 --max-error 0.05 --target m7 --out half_derivative.h\n"
        "         glsum generate --order 0.5 --kernel ring_plain_q31 --taps 300 --out half_derivative.h --verify\n"
        "         glsum generate --controller pid.json --plant model.json --out pid.h --verify");
    command.callback([options, budget, &words] { run(*options, *budget, words.line); });
}

}  // namespace cli
