#include "bench/choose/question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "base/failure.hpp"
#include "bench/choose/earlier.hpp"
#include "bench/run/context.hpp"
#include "bench/sweep/designs.hpp"
#include "glsum/catalogue.hpp"

namespace choose {
namespace {

using glsum::Exit;
using glsum::Failure;

bench::Json context_of(const Question& question, const std::optional<qemu::Board>& board) {
    bench::Sweep sweep;
    sweep.kernels = question.kernels;
    sweep.orders = {question.conditions.order};
    sweep.signals = question.conditions.signals;
    sweep.samples = question.conditions.samples;
    sweep.seed = question.conditions.seed;
    if (!question.core.empty()) {
        sweep.cores = {question.core};
    }
    bench::Json context =
        bench::make_context({}, sweep, board ? std::vector<qemu::Board>{*board} : std::vector<qemu::Board>{});
    context["executable"] = "glsum choose";
    context["step_s"] = question.conditions.step_s;
    return context;
}

// Errors of the question's records or of its goal; `measured` is empty for a goal.
struct Errors {
    std::unique_ptr<MeasuredErrors> measured;
    std::unique_ptr<DerivativeErrors> fitted;
    [[nodiscard]] ErrorSource& source() const {
        return measured ? static_cast<ErrorSource&>(*measured) : static_cast<ErrorSource&>(*fitted);
    }
};

Errors make_errors(const Question& question, const Earlier& earlier) {
    Errors errors;
    if (question.goal) {
        errors.fitted = std::make_unique<DerivativeErrors>(*question.goal, question.by);
    } else {
        errors.measured = std::make_unique<MeasuredErrors>(question.conditions.order,
                                                           make_records(question.conditions, question.jobs));
        remember(earlier, question, *errors.measured);
    }
    return errors;
}

// Why some kernels are not asked: for each reason how many.
std::vector<std::string> leave_out(std::vector<std::string>& kernels) {
    std::map<std::string, std::vector<std::string>> reasons;
    std::erase_if(kernels, [&](const std::string& kernel) {
        const std::string why = DerivativeErrors::why_not(kernel);
        if (!why.empty()) {
            reasons[why].push_back(kernel);
        }
        return !why.empty();
    });
    std::vector<std::string> notes;
    for (const auto& [why, left_out] : reasons) {
        notes.push_back(fmt::format("left out, since {}: {}", why, fmt::join(left_out, ", ")));
    }
    return notes;
}

// Those that come near what the nearest comes to, and those that meet the error and cost too much.
std::vector<std::string> nearest_of(const std::vector<Outcome>& outcomes) {
    constexpr double near = 1.5;
    double least = std::numeric_limits<double>::infinity();
    for (const Outcome& outcome : outcomes) {
        least = outcome.short_of ? std::min(least, outcome.short_of->error.error) : least;
    }
    std::vector<std::string> kernels;
    for (const Outcome& outcome : outcomes) {
        if (outcome.best || (outcome.short_of && outcome.short_of->error.error <= near * least)) {
            kernels.push_back(outcome.kernel);
        }
    }
    return kernels;
}

// Costs of the question's target; `note` says where they come from.
std::unique_ptr<CostSource> make_costs(const Question& question, const Earlier& earlier,
                                       const std::optional<qemu::Board>& board, std::string& note) {
    if (question.target == Target::host) {
        if (question.max_instructions) {
            throw Failure(Exit::bad_input,
                          "--max-instructions: only with --target m7 or m4; on the host use --max-cycles");
        }
        note = fmt::format(
            "host times: taken in this run alone, {} interleaved repetitions of each candidate, never of a file",
            HostTimes::repetitions);
        return std::make_unique<HostTimes>(question.counted_order(), question.conditions.samples);
    }
    if (question.max_instructions && !question.core.empty()) {
        throw Failure(Exit::bad_input, "--max-instructions: with --core use --max-cycles");
    }
    if (question.max_cycles && question.core.empty()) {
        throw Failure(Exit::bad_input, "--max-cycles: with --max-instructions only instructions are counted");
    }
    if (!board) {
        throw Failure(Exit::missing, fmt::format("the emulated board is needed for --target {} and was not found",
                                                 word_of(question.target)));
    }
    note = question.core.empty() ? fmt::format("counted on the {}; instructions are not cycles", board->name())
                                 : fmt::format("cycles: modelled for {}, on the {}", question.core, board->name());
    auto costs = std::make_unique<OnTarget>(*board, question.counted_order(), question.conditions.samples,
                                            question.conditions.seed, question.jobs, question.core);
    remember(earlier, question, *costs);
    return costs;
}

}  // namespace

const base::Machine* machine_of(Target target) {
    return target == Target::host ? nullptr : base::machine_called(word_of(target));
}

std::string_view word_of(Target target) { return target == Target::host ? "host" : target == Target::m7 ? "m7" : "m4"; }

std::optional<Target> target_called(std::string_view word) {
    for (const Target target : {Target::host, Target::m7, Target::m4}) {
        if (word_of(target) == word) {
            return target;
        }
    }
    return std::nullopt;
}

std::vector<std::string> kernels_of(Target target, double order) {
    std::vector<std::string> kernels;
    for (const glsum::CatalogueEntry& kernel : glsum::catalogue) {
        const std::string name(kernel.name);
        const bool of_another_order = kernel.integrator && !bench::serves(name, order);
        if (!kernel.history.empty() && (target == Target::host || !kernel.host_only) && !of_another_order) {
            kernels.push_back(name);
        }
    }
    return kernels;
}

std::string what_a_whole_order_is(double order) {
    if (order != std::round(order)) {
        return "";
    }
    return order < 0.0 ? "a whole order: the sum is that of all samples so far, one addition without any kernel"
                       : fmt::format(
                             "a whole order: the sum has {} weight{} and no memory beyond, exact in a window of "
                             "as many taps",
                             order + 1.0, order > 0.0 ? "s" : "");
}

Answer answer(const Question& question, const std::optional<qemu::Board>& board) {
    Answer answer;
    answer.question = question;
    answer.context = context_of(question, board);
    const Earlier earlier = read_earlier(question, answer.context);
    std::string cost_note;
    const std::unique_ptr<CostSource> costs = make_costs(question, earlier, board, cost_note);
    const Errors errors = make_errors(question, earlier);
    std::vector<std::string> kernels = question.kernels;
    const std::vector<std::string> left_out = question.goal ? leave_out(kernels) : std::vector<std::string>{};
    const Limits limits{
        question.max_error,
        question.target != Target::host && question.max_instructions ? question.max_instructions : question.max_cycles,
        question.max_bytes};
    answer.choice = choose(errors.source(), *costs, kernels, limits, question.jobs);
    answer.unit = costs->unit();
    answer.limited_unit = costs->limited_unit();
    answer.notes = {earlier.note, cost_note};
    answer.notes.push_back(
        errors.measured
            ? fmt::format("{} records run through kernels for their errors, {} errors taken from the file",
                          errors.measured->measured(), errors.measured->remembered())
            : fmt::format("errors: of {} for each length, as the kernel's format holds it, and of the noise of its "
                          "arithmetic",
                          text_of(question.by)));
    if (errors.fitted && answer.choice.chosen) {
        const Candidate& chosen = *answer.choice.chosen;
        answer.derivative =
            report_on(chosen.kernel, chosen.taps, *question.goal, errors.fitted->filter_of(chosen.kernel, chosen.taps));
    }
    if (errors.fitted && !answer.choice.chosen && question.by == FilterDesign::fitted) {
        answer.would_do =
            what_would_do(*question.goal, nearest_of(answer.choice.kernels), *costs, limits, question.jobs);
    }
    if (const auto* counted = dynamic_cast<const OnTarget*>(costs.get())) {
        answer.notes.back() +=
            fmt::format("; {} costs measured, {} taken from the file", counted->measured(), counted->remembered());
    }
    if (const std::string whole = what_a_whole_order_is(question.conditions.order); !whole.empty()) {
        answer.notes.push_back(whole);
    }
    answer.notes.insert(answer.notes.end(), left_out.begin(), left_out.end());
    if (const auto* timed = dynamic_cast<const HostTimes*>(costs.get())) {
        answer.notes.push_back("host cycles: " + timed->cycle_counter());
    }
    return answer;
}

Answer measure_one(const Question& question, const std::string& kernel, std::size_t taps,
                   const std::optional<qemu::Board>& board) {
    Answer answer;
    answer.question = question;
    answer.context = context_of(question, board);
    MeasuredErrors errors(question.conditions.order, make_records(question.conditions, question.jobs));
    Candidate candidate{kernel, taps, errors.error(kernel, taps), {}};
    if (!candidate.error.fault.empty()) {
        throw Failure(Exit::bad_input,
                      fmt::format("{} with {} taps: {}", kernel,
                                  taps_text(candidate, question.counted_order(), question.conditions.samples),
                                  candidate.error.fault));
    }
    std::string note;
    if (question.target != Target::host && !board) {
        candidate.cost.fault = "the emulated board was not found";
        answer.unit = answer.limited_unit = question.core.empty() ? "instructions" : "model cycles";
    } else {
        const auto costs = make_costs(question, {}, board, note);
        candidate.cost = costs->costs({{kernel, taps}}).front();
        answer.unit = costs->unit();
        answer.limited_unit = costs->limited_unit();
    }
    answer.choice.chosen = candidate;
    return answer;
}

}  // namespace choose
