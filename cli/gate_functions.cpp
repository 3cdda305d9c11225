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

}  // namespace

void gate_functions(const GatedElf& options) {
    constexpr std::size_t most_bytes = 64U << 20;
    if (options.update && options.reason.find_first_not_of(" \t\n") == std::string::npos) {
        throw Failure(Exit::bad_input, "--update-baseline: expected --reason TEXT, which the baseline keeps");
    }
    if (!options.update && !std::filesystem::exists(options.baseline)) {
        throw Failure(Exit::bad_input, fmt::format("{}: no such baseline; --update-baseline --reason TEXT records one",
                                                   options.baseline.string()));
    }
    const qemu::GatedProgram now = gated_program(options);
    if (options.update) {
        base::write_file(options.baseline, qemu::to_json(now, options.reason));
        fmt::print("{}: {} functions recorded\n", options.baseline.string(), now.functions.size());
        return;
    }
    const qemu::GatedProgram before =
        qemu::parse_gated_program(base::read_file(options.baseline, most_bytes), options.baseline.string());
    std::string worse;
    const std::vector<qemu::FunctionChange> changes = qemu::changes(before, now);
    for (const qemu::FunctionChange& change : changes) {
        fmt::print("{:<6} {}: {}\n", change.worse ? "worse" : "passes", change.name, change.text);
        worse += change.worse ? (worse.empty() ? "" : ", ") + change.name : "";
    }
    fmt::print("{} functions on {}, {} changed\n", now.functions.size(), now.core, changes.size());
    if (!worse.empty()) {
        throw Failure(Exit::check_failed, "gate: worse: " + worse);
    }
}

}  // namespace cli
