#include "bench/choose/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/choose/derivative_text.hpp"
#include "bench/sweep/designs.hpp"

namespace choose {
namespace {

std::string count(double value) {
    return std::fabs(value - std::round(value)) < 0.05 ? fmt::format("{:.0f}", value) : fmt::format("{:.1f}", value);
}

std::string hertz(double hz) {
    return hz >= 1e6   ? fmt::format("{:g} MHz", hz / 1e6)
           : hz >= 1e3 ? fmt::format("{:g} kHz", hz / 1e3)
                       : fmt::format("{:g} Hz", hz);
}

// "max_error" as the user typed it.
std::string option(const Answer& answer, const std::string& limit) {
    if (limit == "max_cost") {
        return answer.unit == "instructions" ? "--max-instructions" : "--max-cycles";
    }
    return limit != "max_error" ? "--max-bytes" : answer.question.goal ? "--derivative-error" : "--max-error";
}

// "5 %" or "0.05": an error as the user asked for it.
std::string error_text(const Answer& answer, double error) {
    return answer.question.goal ? fmt::format("{:.3g} %", 100.0 * error) : fmt::format("{:.3g}", error);
}

// Relaxed upwards to two or three digits, so that it may be typed.
std::string relaxed_value(const Answer& answer, const Relaxed& relaxed) {
    if (relaxed.limit != "max_error") {
        return fmt::format("{:.0f}", std::ceil(relaxed.to));
    }
    const double unit = std::pow(10.0, std::floor(std::log10(relaxed.to)) - 2.0);
    const double up = std::ceil(relaxed.to / unit * (1.0 - 1e-12)) * unit;
    return answer.question.goal ? fmt::format("{:.3g}%", 100.0 * up) : fmt::format("{:.3g}", up);
}

std::string taps_of(const Answer& answer, const Candidate& candidate) {
    return taps_text(candidate, answer.question.counted_order(), answer.question.conditions.samples);
}

std::string at(const Answer& answer, const Candidate& candidate) {
    return fmt::format("{} with {} taps", candidate.kernel, taps_of(answer, candidate));
}

// Of what is beyond it.
double limit_of_cost(const Question& question) {
    return question.max_cycles ? *question.max_cycles : question.max_instructions.value();
}

std::string why(const Answer& answer, const Outcome& outcome) {
    const auto& chosen = answer.choice.chosen;
    const auto times = [&](const Candidate& candidate) {
        return chosen ? fmt::format("{:.3g} times the chosen one's cost", candidate.cost.value / chosen->cost.value)
                      : std::string();
    };
    switch (outcome.standing) {
        case Standing::chosen:
            return "the cheapest that meets every limit";
        case Standing::runner_up:
            return answer.choice.tie ? "as cheap within the noise" : times(*outcome.best);
        case Standing::dominated:
            return outcome.why + ", no worse in error, cost and bytes";
        case Standing::costlier:
            return outcome.already ? fmt::format("at {} taps already {}", taps_of(answer, *outcome.already),
                                                 cost_text(answer, *outcome.already))
                                   : times(*outcome.best);
        case Standing::too_costly:
            return outcome.already ? fmt::format("at {} taps already {}", taps_of(answer, *outcome.already),
                                                 cost_text(answer, *outcome.already))
                                   : fmt::format("{:.3g} times the limit",
                                                 outcome.best->cost.limited / limit_of_cost(answer.question));
        case Standing::too_large:
            return fmt::format("{:.3g} times the limit", outcome.best->cost.bytes / answer.question.max_bytes.value());
        case Standing::inaccurate:
            return fmt::format("gets to {:.2e} at best, at {} taps", outcome.short_of->error.error,
                               taps_of(answer, *outcome.short_of));
        case Standing::wrong:
            return outcome.why;
    }
    return "";
}

std::string line_of(const Answer& answer, const Outcome& outcome) {
    std::string taps = "-";
    std::string error = "-";
    std::string signal = "-";
    std::string cost = "-";
    std::string bytes = "-";
    if (const auto& shown = outcome.best ? outcome.best : outcome.short_of) {
        taps = taps_of(answer, *shown);
        error = fmt::format("{:.2e}", shown->error.error);
        signal = shown->error.signal;
        if (outcome.best && !outcome.already && shown->cost.fault.empty()) {
            cost = count(shown->cost.value);
            bytes = count(shown->cost.bytes);
        }
    }
    std::string line = fmt::format("  {:<24} {:>6} {:>9}  {:<7} {:>10} {:>8}  {}", outcome.kernel, taps, error, signal,
                                   cost, bytes, to_text(outcome.standing));
    if (const std::string reason = why(answer, outcome); !reason.empty()) {
        line += ": " + reason;
    }
    return line;
}

void state(bench::Json& json, const glsum::design::DerivativeGoal& goal) {
    json["step_s"] = goal.step_s;
    if (goal.band) {
        json["band_hz"] = {goal.band->low_hz, goal.band->high_hz};
    }
    if (goal.step_until_s) {
        json["step_until_s"] = *goal.step_until_s;
    }
}

bench::Json to_json(const Answer& answer, const Candidate& candidate) {
    bench::Json json;
    json["kernel"] = candidate.kernel;
    json["taps"] = candidate.taps;
    const auto& conditions = answer.question.conditions;
    const bench::Length length =
        answer.question.counted_order().length(candidate.kernel, candidate.taps, conditions.samples);
    if (length.modes) {
        json["near_taps"] = candidate.taps - 2 * *length.modes;
        json["modes"] = *length.modes;
    }
    if (length.blocks) {
        json["near_taps"] = candidate.taps - length.blocks->count;
        json["blocks"] = length.blocks->count;
        json["blocks_per_level"] = length.blocks->per_level;
    }
    json[answer.question.goal ? "derivative_error" : "error_max"] = candidate.error.error;
    json[answer.question.goal ? "worst_at" : "worst_signal"] = candidate.error.signal;
    const bool known = candidate.cost.fault.empty() && candidate.cost.bytes > 0.0;
    if (known && answer.question.target == Target::host) {
        json["ns_per_sample"] = candidate.cost.value;
        json["ns_per_sample_noise"] = candidate.cost.noise;
        json["cycles_per_sample"] = candidate.cost.limited;
    } else if (known && answer.unit == "instructions") {
        json["instructions_per_sample"] = candidate.cost.value;
    } else if (known) {
        json["model_cycles_per_sample"] = candidate.cost.value;
        json["model_cycles_high"] = candidate.cost.limited;
    }
    if (known) {
        json["bytes"] = candidate.cost.bytes;
    }
    return json;
}

}  // namespace

std::string cost_text(const Answer& answer, const Candidate& candidate) {
    const Cost& cost = candidate.cost;
    if (answer.question.target == Target::host) {
        return fmt::format("{:.1f} +- {:.1f} ns, {} cycles", cost.value, cost.noise, count(cost.limited));
    }
    if (cost.limited > cost.value) {
        return fmt::format("{} {}, at most {}", count(cost.value), answer.unit, count(cost.limited));
    }
    return fmt::format("{} {}", count(cost.value), answer.unit);
}

// How many instructions the core issues in a cycle at most: 2 where no machine is known.
unsigned width_of(const Question& question) {
    const base::Machine* const machine = machine_of(question.target);
    return machine != nullptr ? machine->issues_a_cycle : 2;
}

std::string budget_share(const Answer& answer, const Candidate& candidate) {
    const Question& question = answer.question;
    if (!question.clock_hz || !question.rate_hz) {
        return "";
    }
    const double budget = *question.clock_hz / *question.rate_hz;
    const std::string time =
        fmt::format("{} at {} samples a second leave {} cycles a sample", hertz(*question.clock_hz),
                    fmt::format("{:g}", *question.rate_hz), count(budget));
    if (answer.unit == "instructions") {
        const unsigned width = width_of(question);
        const double least = candidate.cost.value / width;
        return fmt::format(
            "{}; a core that issues {} a cycle needs at least {} of them for {} instructions: "
            "at least {:.3g} %, and more by every stall",
            time, width == 1 ? "one instruction" : "two instructions", count(std::ceil(least)),
            count(candidate.cost.value), 100.0 * least / budget);
    }
    return fmt::format("{}; {} takes {:.3g} %", time,
                       answer.unit == "ns" ? "the host's cycle count" : "the model's upper end",
                       100.0 * candidate.cost.limited / budget);
}

std::string nearest_miss(const Answer& answer) {
    if (answer.choice.chosen) {
        return "";
    }
    if (answer.choice.relaxed.empty()) {
        return "nothing fits, and relaxing any one limit alone does not help";
    }
    const Relaxed& nearest = answer.choice.relaxed.front();
    return fmt::format("nothing fits; nearest miss: {} misses {} by {:.3g} %, with {} {} it fits",
                       at(answer, nearest.fits), option(answer, nearest.limit), 100.0 * (nearest.factor() - 1.0),
                       option(answer, nearest.limit), relaxed_value(answer, nearest));
}

std::string to_table(const Answer& answer, bool colour) {
    const Question& question = answer.question;
    const Conditions& conditions = question.conditions;
    std::string text = question.goal
                           ? fmt::format("derivative of order {}, h = {:g} s, within {:g} %{}\n", conditions.order,
                                         conditions.step_s, 100.0 * question.max_error, extent(*question.goal))
                           : fmt::format("order {}, h = {:g} s, error at most {:g}: the worst of {} over {} samples\n",
                                         conditions.order, conditions.step_s, question.max_error,
                                         fmt::join(conditions.signals, ", "), conditions.samples);
    const auto limit = [&](const char* name, const std::optional<double>& value) {
        if (value) {
            text += fmt::format("at most {} {}\n", count(*value), name);
        }
    };
    limit("cycles a sample", question.max_cycles);
    limit("instructions a sample", question.max_instructions);
    limit("bytes of state and coefficients", question.max_bytes);
    const auto strong = [&](const std::string& words) { return colour ? "\033[1m" + words + "\033[0m" : words; };
    const auto headline = [&](const char* what, const Candidate& candidate) {
        text += fmt::format("\n{:<10} {}: error {} ({}), {}, {} bytes", what, strong(at(answer, candidate)),
                            error_text(answer, candidate.error.error), candidate.error.signal,
                            cost_text(answer, candidate), count(candidate.cost.bytes));
    };
    if (answer.choice.chosen) {
        headline("choice", *answer.choice.chosen);
        if (answer.choice.runner_up) {
            headline("runner-up", *answer.choice.runner_up);
            text += answer.choice.tie ? "; within the noise as cheap" : "";
        }
        text += '\n';
        if (answer.derivative) {
            text += use_of(*answer.derivative, *question.goal) +
                    fmt::format("{:<10} derivative = {} S_k\n", "factor", answer.derivative->filter.factor);
        }
        if (const std::string share = budget_share(answer, *answer.choice.chosen); !share.empty()) {
            text += fmt::format("{:<10} {}\n", "real time", share);
        }
    } else {
        text += fmt::format("\n{}\n", strong(nearest_miss(answer)));
        for (const Relaxed& relaxed : answer.choice.relaxed) {
            text += fmt::format(
                "  {} {} instead of {} (times {:.3g}): {}, error {}, {}, {} bytes\n", option(answer, relaxed.limit),
                relaxed_value(answer, relaxed),
                relaxed.limit == "max_error" ? error_text(answer, relaxed.from) : fmt::format("{:g}", relaxed.from),
                relaxed.factor(), at(answer, relaxed.fits), error_text(answer, relaxed.fits.error.error),
                cost_text(answer, relaxed.fits), count(relaxed.fits.cost.bytes));
        }
        for (const WouldDo& other : answer.would_do) {
            text += fmt::format("  {}: {}, error {}, {}, {} bytes\n", other.instead, at(answer, other.fits),
                                error_text(answer, other.fits.error.error), cost_text(answer, other.fits),
                                count(other.fits.cost.bytes));
        }
    }
    text += fmt::format("\n  {:<24} {:>6} {:>9}  {:<7} {:>10} {:>8}  {}\n", "kernel", "taps", "error", "worst",
                        answer.unit == "model cycles" ? "cycles"
                        : answer.unit == "ns"         ? "ns"
                                                      : "instr.",
                        "bytes", "verdict");
    std::vector<const Outcome*> order;
    for (const Outcome& outcome : answer.choice.kernels) {
        order.push_back(&outcome);
    }
    const auto key = [](const Outcome* outcome) {
        const bool costed = outcome->best && !outcome->already;
        return std::make_tuple(
            static_cast<int>(outcome->standing == Standing::dominated ? Standing::costlier : outcome->standing),
            costed              ? outcome->best->cost.value
            : outcome->short_of ? outcome->short_of->error.error
                                : 1e300);
    };
    std::stable_sort(order.begin(), order.end(), [&](const Outcome* a, const Outcome* b) { return key(a) < key(b); });
    for (const Outcome* outcome : order) {
        const bool dim = colour && outcome->standing != Standing::chosen && outcome->standing != Standing::runner_up;
        const std::string line = line_of(answer, *outcome);
        text += dim ? "\033[2m" + line + "\033[0m\n" : line + "\n";
    }
    text += "\n";
    for (const std::string& note : answer.notes) {
        text += "  " + note + "\n";
    }
    return text;
}

bench::Json to_json(const Answer& answer) {
    const Question& question = answer.question;
    bench::Json json;
    json["schema"] = "glsum-choice-1";
    json["fits"] = answer.choice.chosen.has_value();
    bench::Json& asked = json["question"];
    asked["order"] = question.conditions.order;
    asked["step_s"] = question.conditions.step_s;
    asked["target"] = word_of(question.target);
    asked["core"] = question.core;
    if (question.goal) {
        asked["derivative_error"] = question.max_error;
        state(asked, *question.goal);
    } else {
        asked["signals"] = question.conditions.signals;
        asked["max_error"] = question.max_error;
    }
    const auto optional = [](bench::Json& to, const char* name, const std::optional<double>& value) {
        if (value) {
            to[name] = *value;
        }
    };
    optional(asked, "max_cycles", question.max_cycles);
    optional(asked, "max_instructions", question.max_instructions);
    optional(asked, "max_bytes", question.max_bytes);
    optional(asked, "clock_hz", question.clock_hz);
    optional(asked, "rate_hz", question.rate_hz);
    if (answer.choice.chosen) {
        json["choice"] = to_json(answer, *answer.choice.chosen);
        if (answer.derivative) {
            json["certified"] = to_json(answer.derivative->certified, *question.goal);
            json["measured"] = to_json(answer.derivative->measured, *question.goal);
            json["factor"] = answer.derivative->filter.factor;
        }
        if (const std::string share = budget_share(answer, *answer.choice.chosen); !share.empty()) {
            bench::Json& real_time = json["real_time"];
            const double budget = *question.clock_hz / *question.rate_hz;
            real_time["cycles_a_sample"] = budget;
            const bool counted = answer.unit == "instructions";
            real_time[counted ? "share_at_least" : "share"] =
                (counted ? answer.choice.chosen->cost.value / width_of(question) : answer.choice.chosen->cost.limited) /
                budget;
            real_time["text"] = share;
        }
    }
    if (answer.choice.runner_up) {
        json["runner_up"] = to_json(answer, *answer.choice.runner_up);
        json["tie_within_noise"] = answer.choice.tie;
    }
    if (!answer.choice.chosen) {
        bench::Json& misses = json["nearest_misses"] = bench::Json::array();
        for (const Relaxed& relaxed : answer.choice.relaxed) {
            bench::Json miss;
            miss["limit"] = option(answer, relaxed.limit).substr(2);
            miss["from"] = relaxed.from;
            miss["to"] = relaxed.to;
            miss["factor"] = relaxed.factor();
            miss["fits"] = to_json(answer, relaxed.fits);
            misses.push_back(std::move(miss));
        }
        for (const WouldDo& other : answer.would_do) {
            bench::Json would = {{"instead", other.instead}, {"fits", to_json(answer, other.fits)}};
            state(would, other.goal);
            json["would_do"].push_back(std::move(would));
        }
    }
    bench::Json& kernels = json["kernels"] = bench::Json::array();
    for (const Outcome& outcome : answer.choice.kernels) {
        const auto& shown = outcome.best ? outcome.best : outcome.short_of;
        bench::Json row = shown ? to_json(answer, *shown) : bench::Json{{"kernel", outcome.kernel}};
        row["verdict"] = to_text(outcome.standing);
        row["why"] = why(answer, outcome);
        kernels.push_back(std::move(row));
    }
    json["notes"] = answer.notes;
    json["context"] = answer.context;
    return json;
}

}  // namespace choose
