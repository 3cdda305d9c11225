#include "cli/gate_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/scratch.hpp"
#include "base/sha256.hpp"
#include "qemu/emulate/foreign_program.hpp"
#include "qemu/emulate/function_gate.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

qemu::GatedProgram gated_program(const GatedElf& options) {
    const qemu::Elf elf(options.timed.elf);
    const timing::TimingRequest request = to_request(options.timed, elf);
    const timing::CoreFile core = timing::cores_of(request).front();
    qemu::check_runs_on_board(elf, base::machine_of_core(timing::name_of(core.core)));
    const std::vector<qemu::Function> functions = elf.functions_like(options.functions);
    const std::vector<timing::TimingLog> logs = time_functions(options.timed, functions, request, true);
    std::string placed = core.text + timing::name_of(core.placement.code) + timing::name_of(core.placement.data);
    for (const timing::PlacedRange& range : core.placement.ranges) {
        placed += timing::name_of(range.place);  // addresses move with the program
    }
    const base::Scratch scratch;
    base::write_file(scratch.file("core"), placed);
    qemu::GatedProgram program{
        base::sha256_of(options.timed.elf), core.name, base::sha256_of(scratch.file("core")), {}};
    for (std::size_t f = 0; f < functions.size(); ++f) {
        program.functions.push_back(qemu::gated_function(
            functions[f], elf, logs[f].runs.empty() ? std::nullopt : std::optional(qemu::function_time(logs[f]))));
    }
    std::sort(program.functions.begin(), program.functions.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    return program;
}

using bench::gate::Finding;
using bench::gate::Layer;
using bench::gate::Level;
using bench::gate::Verdict;

// The functions as rows of a gate: one that grew fails, one that shrank is better, a new one is noted.
Verdict verdict_of(const qemu::GatedProgram& now, const std::vector<qemu::FunctionChange>& changes) {
    Verdict verdict;
    auto& count = verdict.count(Layer::model_cycles);
    for (const qemu::GatedFunction& function : now.functions) {
        verdict.rows.push_back(function.name);
    }
    for (const qemu::FunctionChange& change : changes) {
        const bool is_new = change.text.starts_with("new");
        Finding finding;
        finding.level = change.worse ? Level::fail : is_new ? Level::note : Level::improvement;
        finding.layer = Layer::model_cycles;
        finding.row = change.name;
        finding.what = change.text;
        finding.reason = "the same program takes the same on every machine";
        count.failed += change.worse ? 1 : 0;
        count.better += finding.level == Level::improvement ? 1 : 0;
        verdict.findings.push_back(std::move(finding));
    }
    std::stable_sort(verdict.findings.begin(), verdict.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.level < b.level; });
    count.compared = now.functions.size();
    verdict.status = count.failed > 0 ? Exit::check_failed : Exit::good;
    return verdict;
}

}  // namespace

void gate_functions(const GatedElf& options, const std::function<void(const Verdict&)>& write, bool is_text) {
    constexpr std::size_t most_bytes = 64U << 20;
    if (options.update && options.reason.find_first_not_of(" \t\n") == std::string::npos) {
        throw Failure(Exit::bad_input, "--update-baseline: expected --reason TEXT, which the baseline keeps");
    }
    if (!options.update && !std::filesystem::exists(options.baseline)) {
        throw Failure(Exit::bad_input, fmt::format("{}: no such baseline; --update-baseline --reason TEXT records one",
                                                   options.baseline.string()));
    }
    const auto tell = [&](Verdict verdict) {
        verdict.baseline_name = options.baseline.string();
        verdict.current_name = options.timed.elf.string();
        write(verdict);
    };
    const qemu::GatedProgram now = gated_program(options);
    if (options.update) {
        base::write_file(options.baseline, qemu::to_json(now, options.reason));
        fmt::print("{}: {} functions recorded\n", options.baseline.string(), now.functions.size());
        return;
    }
    const qemu::GatedProgram before =
        qemu::parse_gated_program(base::read_file(options.baseline, most_bytes), options.baseline.string());
    std::string worse;
    std::vector<qemu::FunctionChange> changes;
    try {
        changes = qemu::changes(before, now);
    } catch (const Failure& refused) {
        Verdict verdict;
        verdict.status = refused.status();
        verdict.refusal = refused.what();
        tell(verdict);
        throw;
    }
    std::string text;
    for (const qemu::FunctionChange& change : changes) {
        text += fmt::format("{:<6} {}: {}\n", change.worse ? "worse" : "passes", change.name, change.text);
        worse += change.worse ? (worse.empty() ? "" : ", ") + change.name : "";
    }
    tell(verdict_of(now, changes));
    if (is_text) {
        fmt::print("{}{} functions on {}, {} changed\n", text, now.functions.size(), now.core, changes.size());
    }
    if (!worse.empty()) {
        throw Failure(Exit::check_failed, "gate: worse: " + worse);
    }
}

}  // namespace cli
