// A budget as the question that is asked of the kernels.
#include "cli/budget.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "bench/sweep/signals.hpp"
#include "cli/board.hpp"
#include "cli/derivative_goal.hpp"
#include "glsum/weights.hpp"
#include "qemu/emulate/foreign_program.hpp"

namespace cli {
namespace {

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
    question.target = *target;
    const bool counts = question.target == choose::Target::host || (budget.max_instructions && budget.core.empty());
    question.core = counts ? "" : core_of(budget);
    question.kernels = choose::kernels_of(question.target, question.conditions.order);
    question.max_error = goal ? derivative_error(budget) : budget.max_error;
    question.goal = goal;
    question.by = filter_design(budget);
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

}  // namespace cli
