#include "cli/budget.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "bench/choose/derivative_plot.hpp"
#include "bench/sweep/signals.hpp"
#include "cli/board.hpp"
#include "cli/derivative_goal.hpp"
#include "glsum/weights.hpp"
#include "qemu/emulate/foreign_program.hpp"

namespace cli {
namespace {

// Exact sums of each sample with all before it, in 50 digits: more would take minutes.
constexpr std::size_t most_samples_of_a_sum = 8000;

[[noreturn]] void refuse(const std::string& what) { throw glsum::Failure(glsum::Exit::bad_input, what); }

void check_positive(const char* option, const std::optional<double>& value) {
    if (value && !(std::isfinite(*value) && *value > 0.0)) {
        refuse(fmt::format("{}: expected a number above 0, found {}", option, *value));
    }
}

std::vector<std::string> to_signals(const Budget& budget) {
    std::vector<std::string> signals;
    for (const std::string& signal : budget.signals) {
        if (std::find(std::begin(bench::signal_names), std::end(bench::signal_names), signal) ==
            std::end(bench::signal_names)) {
            refuse(
                fmt::format("--signal: expected some of {}, found {}", fmt::join(bench::signal_names, ", "), signal));
        }
        if (!bench::can_be_sampled(signal, budget.step_s)) {
            refuse(fmt::format("--signal: {} needs more than two samples a period; --step-s {} gives fewer", signal,
                               budget.step_s));
        }
        if (std::find(signals.begin(), signals.end(), signal) == signals.end()) {
            signals.push_back(signal);
        }
    }
    if (signals.empty()) {
        for (const std::string_view name : bench::signal_names) {
            if (bench::can_be_sampled(name, budget.step_s)) {
                signals.emplace_back(name);
            }
        }
    }
    return signals;
}

}  // namespace

std::shared_ptr<Budget> add_budget(Command& command, bool needs_order) {
    auto budget = std::make_shared<Budget>();
    budget->jobs = std::max(1U, std::thread::hardware_concurrency());
    Option order = command.add_option("--order", budget->order, "Order v in (-2, 2]").within(-2, 2);
    if (needs_order) {
        order.required();
    } else {
        budget->order = std::numeric_limits<double>::quiet_NaN();
    }
    command
        .add_option("--step-s", budget->step_s,
                    "Seconds from sample to sample: the sines and the drive's response are sampled there")
        .within(0, 1000);
    command
        .add_option("--max-error", budget->max_error,
                    "Largest error of the sum, relative to the largest exact full-memory sum, before h^-v")
        .above(0);
    command.add_option("--derivative-error", budget->derivative_error,
                       "In place of --max-error: largest relative error of the derivative (or integral) itself, as in "
                       "5%, over a --band, along a step (--step-until), or both");
    command.add_option("--band", budget->band,
                       "Hertz, as in 0.05..80: there |H - (jw)^v| / w^v is held within --derivative-error");
    command
        .add_option("--step-until", budget->step_until_s,
                    "Seconds: until then, from ten samples on, the response to a unit step is held within it of "
                    "t^-v / Gamma(1 - v)")
        .above(0);
    command.add_option("--plot", budget->plot,
                       "With --derivative-error: draws gain, phase and step response there (FILE.svg and FILE.png)");
    command.add_option("--signal", budget->signals, "The error is the worst of these records (default: all of them)")
        .delimiter(',');
    command
        .add_option("--max-cycles", budget->max_cycles, "Cycles a sample: the host's, or the timing model's upper end")
        .above(0);
    command
        .add_option("--max-instructions", budget->max_instructions,
                    "Instructions a sample, --target m7 or m4: ranked and limited in place of cycles")
        .above(0);
    command.add_option("--max-bytes", budget->max_bytes, "Bytes of state and coefficients").above(0);
    command.add_option("--clock-hz", budget->clock_hz, "The core's clock: with --rate-hz, says the share of real time")
        .above(0);
    command.add_option("--rate-hz", budget->rate_hz, "Samples a second").above(0);
    command.add_option("--target", budget->target, "host, m7 or m4; choose takes m7,m4: both beside each other");
    command.add_option(
        "--core", budget->core,
        fmt::format("Core of the timing model, a file of qemu/cores, whose cycles are ranked and limited "
                    "(default with --target m7: {}, m4: {}; with --max-instructions: none, instructions are)",
                    base::machines[0].default_core, base::machines[1].default_core));
    command.add_option("--results", budget->results,
                       "Earlier measurements (default: results/latest.json if it is there); only rows of this very "
                       "build count, at h = 1 ms");
    command.add_flag("--fresh", budget->fresh, "Measure everything, whatever the results hold");
    command.add_flag("--quick", budget->quick, "Records of 1000 samples instead of 5000, like bench --quick");
    command
        .add_option("--samples", budget->samples,
                    needs_order ? "Records of so many samples"
                                : "Records of so many samples; 8000 at most, of a controller or a model ten million")
        .between(2, needs_order ? most_samples_of_a_sum : 10'000'000);
    command.add_option("--jobs", budget->jobs, "Threads and emulators at once").at_least(1);
    return budget;
}

std::string core_of(const Budget& budget) {
    const base::Machine* const machine = base::machine_called(budget.target);
    return !budget.core.empty() ? budget.core
                                : std::string((machine != nullptr ? *machine : base::machines.front()).default_core);
}

std::size_t samples_of(const Budget& budget) {
    return budget.samples != 0 ? budget.samples : budget.quick ? 1000 : 5000;
}

choose::Question to_question(const Budget& budget) {
    if (!glsum::order_in_range(budget.order)) {
        refuse(fmt::format("--order: expected a number in (-2, 2], found {}", budget.order));
    }
    if (!(budget.step_s > 0.0 && budget.step_s <= 1000.0)) {
        refuse(fmt::format("--step-s: expected seconds above 0, up to 1000, found {}", budget.step_s));
    }
    const auto goal = derivative_goal(budget);
    if (!goal && !(std::isfinite(budget.max_error) && budget.max_error > 0.0)) {
        refuse(fmt::format("--max-error: expected a number above 0, found {}", budget.max_error));
    }
    check_positive("--max-cycles", budget.max_cycles);
    check_positive("--max-instructions", budget.max_instructions);
    check_positive("--max-bytes", budget.max_bytes);
    check_positive("--clock-hz", budget.clock_hz);
    check_positive("--rate-hz", budget.rate_hz);
    if (budget.clock_hz.has_value() != budget.rate_hz.has_value()) {
        refuse("--clock-hz and --rate-hz: expected both or none");
    }
    if (budget.rate_hz && std::fabs(*budget.rate_hz * budget.step_s - 1.0) > 0.01) {
        refuse(fmt::format("--rate-hz: expected 1 / --step-s, {:.6g}, found {}", 1.0 / budget.step_s, *budget.rate_hz));
    }
    const std::optional<choose::Target> target = choose::target_called(budget.target);
    if (!target) {
        refuse(fmt::format("--target: expected host, {}, found {}", fmt::join(base::machine_words(), " or "),
                           budget.target));
    }
    if (*target == choose::Target::host && !budget.core.empty()) {
        refuse("--core: only with --target m7 or m4");
    }
    if (const base::Machine* const machine = choose::machine_of(*target); machine != nullptr && !budget.core.empty()) {
        const base::Machine& of_core = qemu::machine_of({budget.core, "", ""}, cores_folder());
        if (&of_core != machine) {
            refuse(fmt::format("--core {}: of a {}; expected --target {} beside it", budget.core, of_core.name,
                               of_core.word));
        }
    }
    choose::Question question;
    question.conditions.order = budget.order;
    question.conditions.step_s = budget.step_s;
    question.conditions.signals = to_signals(budget);
    question.conditions.samples = samples_of(budget);
    if (question.conditions.samples < 2 || question.conditions.samples > most_samples_of_a_sum) {
        refuse(fmt::format("--samples: expected 2 to {} of a sum, found {}", most_samples_of_a_sum,
                           question.conditions.samples));
    }
    question.target = *target;
    const bool counts = question.target == choose::Target::host || (budget.max_instructions && budget.core.empty());
    question.core = counts ? "" : core_of(budget);
    question.kernels = choose::kernels_of(question.target, question.conditions.order);
    question.max_error = goal ? derivative_error(budget) : budget.max_error;
    question.goal = goal;
    question.max_cycles = budget.max_cycles;
    question.max_instructions = budget.max_instructions;
    question.max_bytes = budget.max_bytes;
    question.clock_hz = budget.clock_hz;
    question.rate_hz = budget.rate_hz;
    question.jobs = budget.jobs;
    if (!budget.fresh) {
        question.results_asked_for = !budget.results.empty();
        question.results = question.results_asked_for
                               ? std::filesystem::path(budget.results)
                               : std::filesystem::path(build_info::source_folder) / "results" / "latest.json";
    }
    return question;
}

void plot_if_asked(const Budget& budget, const choose::Answer& answer) {
    if (!budget.plot.empty()) {
        const std::filesystem::path file(budget.plot);
        const bool named = file.extension() == ".png" || file.extension() == ".svg";
        choose::plot_derivative(answer.derivative.value(), *answer.question.goal, answer.question.max_error,
                                named ? std::filesystem::path(file).replace_extension() : file);
    }
}

std::optional<qemu::Board> board_for(const choose::Question& question) {
    const base::Machine* const machine = choose::machine_of(question.target);
    return machine != nullptr ? built_board(*machine) : board_if_there();
}

}  // namespace cli
