#include "bench/choose/provenance.hpp"

#include <fmt/format.h>

#include "bench/choose/report.hpp"

namespace choose {
namespace {

std::string text(const bench::Json& context, const char* field) {
    const auto found = context.find(field);
    return found == context.end() || !found->is_string() ? "unknown" : found->get<std::string>();
}

std::string commit_of(const bench::Json& context) {
    const std::string commit = text(context, "commit");
    const std::string dirty = text(context, "dirty");
    const bool nobody_knows = commit != "unknown" && dirty == "unknown";
    return commit + (dirty == "true" ? " with changes" : nobody_knows ? " (changes unknown)" : "");
}

}  // namespace

std::vector<std::string> provenance(const Answer& answer, const std::string& command) {
    const Question& question = answer.question;
    const Candidate& chosen = answer.choice.chosen.value();
    const base::Machine* const machine = machine_of(question.target);
    const bool on_target = machine != nullptr;
    std::vector<std::string> lines;
    if (!question.goal) {
        lines = {fmt::format("Measured error {:.3g} ({}): the largest of S_k over {} samples at h = {:g} s,",
                             chosen.error.error, chosen.error.signal, question.conditions.samples,
                             question.conditions.step_s),
                 fmt::format("relative to the largest exact full-memory sum, the worst of {}",
                             fmt::join(question.conditions.signals, ", "))};
    }
    if (question.by != FilterDesign::fitted) {
        lines.push_back(fmt::format("Poles and weights by {} rule, tuned to the band.",
                                    question.by == FilterDesign::oustaloup ? "Oustaloup's" : "Charef's"));
    }
    lines.push_back(chosen.cost.fault.empty()
                        ? fmt::format("Measured cost a sample of the kernel that this is made from: {}{}",
                                      cost_text(answer, chosen),
                                      on_target ? answer.unit == "instructions"
                                                      ? fmt::format(", on an emulated {}: no cycles", machine->name)
                                                      : ", for " + question.core
                                                : " on " + text(answer.context, "cpu"))
                        : fmt::format("Cost not measured: {}", chosen.cost.fault));
    if (answer.choice.runner_up) {
        lines.push_back(
            fmt::format("Runner-up of {} kernels: {} with {} taps, {}", answer.choice.kernels.size(),
                        answer.choice.runner_up->kernel,
                        taps_text(*answer.choice.runner_up, question.counted_order(), question.conditions.samples),
                        cost_text(answer, *answer.choice.runner_up)));
    }
    lines.push_back("");
    lines.push_back("Command: " + command);
    lines.push_back(
        fmt::format("glsum {}, commit {}", text(answer.context, "glsum_version"), commit_of(answer.context)));
    lines.push_back(fmt::format("Errors and expected bits: {}, {}", text(answer.context, "compiler"),
                                text(answer.context, "flags")));
    if (on_target && chosen.cost.fault.empty()) {
        lines.push_back(
            fmt::format("Cost: {}, {}", text(answer.context, "target_compiler"), text(answer.context, "target_flags")));
        lines.push_back(text(answer.context, "qemu_version"));
    }
    return lines;
}

}  // namespace choose
