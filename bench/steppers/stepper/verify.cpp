#include "bench/steppers/stepper/verify.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/verify/target_program.hpp"
#include "bench/verify/verify.hpp"
#include "qemu/emulate/elf.hpp"

namespace generate {
namespace {

using glsum::Exit;
using glsum::Failure;

// What a program says on one line: a number.
std::uint32_t number_from(const std::string& program) {
    FILE* pipe = popen(fmt::format("'{}'", program).c_str(), "r");
    unsigned long number = 0;
    const int read = pipe != nullptr ? std::fscanf(pipe, "%lu", &number) : 0;
    const int status = pipe != nullptr ? pclose(pipe) : -1;
    if (read != 1 || status != 0) {
        throw Failure(Exit::check_failed, "the compiled header: expected a number, found that it stopped");
    }
    return static_cast<std::uint32_t>(number);
}

}  // namespace

CheckedBits check_bits_here(const WrittenStepper& stepper) {
    if (std::system("command -v cc >/dev/null 2>&1") != 0) {
        throw Failure(Exit::missing, "cc: not found, expected this machine's C compiler (Debian package gcc)");
    }
    const base::Scratch scratch;
    write_file(scratch.file((stepper.prefix + ".h").c_str()), stepper.text);
    write_file(scratch.file("check.c"), check_source({stepper}) +
                                            "#include <stdio.h>\nint main(void)\n{\n"
                                            "    return printf(\"%lu\\n\", (unsigned "
                                            "long)entries[0]()) > 0 ? 0 : 1;\n}\n");
    const std::string program = scratch.file("check").string();
    compile(fmt::format("cc -std=c99 -O2 -Wall -Wextra -Wpedantic -Wconversion -Werror '{}' -lm -o '{}'",
                        scratch.file("check.c").string(), program),
            "this machine's C compiler");
    return {"here, compiled by cc", stepper.expected.size(), number_from(program)};
}

std::vector<OnTarget> check_on_target(const std::vector<WrittenStepper>& steppers, const qemu::Board& board,
                                      const timing::TimingRequest& timing) {
    const base::Scratch scratch;
    std::vector<std::string> functions;
    for (const WrittenStepper& stepper : steppers) {
        write_file(scratch.file((stepper.prefix + ".h").c_str()), stepper.text);
        functions.push_back("count_" + stepper.prefix);
    }
    const std::filesystem::path path = link_for_target(target_source(steppers), board, scratch);
    const TargetRun run =
        run_on_target(path, functions, answers_a_stepper * steppers.size(), board, timing, scratch, [] {});
    std::map<std::uint32_t, std::size_t> settled;
    for (const std::uint32_t entry : run.entries) {
        settled[entry] = stepper_calls.taps;
    }
    const auto counted = steady_calls_of(run.counts, settled);
    const qemu::Elf elf(path);
    std::vector<OnTarget> all;
    for (std::size_t i = 0; i < steppers.size(); ++i) {
        const SteadyCalls& step = counted.at(run.entries[i]);
        const qemu::ModelledCall call =
            qemu::modelled_calls(run.timings[i], stepper_calls, stepper_calls.calls(), timing.cores.size(),
                                 step.first_instructions, steppers[i].prefix)
                .at(0);
        const std::uint32_t* const answers = &run.answers[answers_a_stepper * i];
        all.push_back({{"on the " + board.name(), steppers[i].expected.size(), answers[0]},
                       {call.cycles, call.low, call.high, step.instructions,
                        elf.end_of_function(run.entries[i]) - run.entries[i], answers[2], answers[1], board.name()}});
    }
    return all;
}

std::string to_text(const CheckedBits& checked) {
    const std::string found = checked.first_wrong == 0 ? "the library's"
                              : checked.first_wrong == self_check_failed
                                  ? "those of the self-check are others"
                                  : fmt::format("others from step {} on", checked.first_wrong);
    return fmt::format("bits of {} steps and of the self-check, {}: {}", checked.steps, checked.where, found);
}

std::string cost_table(const std::vector<std::pair<std::string, StepCost>>& rows, const std::string& core) {
    std::string text = fmt::format("\n  {:<28} {:>8} {:>17} {:>13} {:>7} {:>7} {:>7}\n", "", "cycles", "band",
                                   "instructions", "state", "tables", "code");
    for (const auto& [name, cost] : rows) {
        text += fmt::format("  {:<28} {:>8.1f} {:>17} {:>13.1f} {:>7} {:>7} {:>7}\n", name, cost.cycles,
                            fmt::format("{:.1f} to {:.1f}", cost.low, cost.high), cost.instructions, cost.state_bytes,
                            cost.table_bytes, cost.code_bytes);
    }
    return text + fmt::format(
                      "\n  a step on the {}; cycles of the timing model for {}; bytes of an instance,\n"
                      "  of the tables and of the step's code\n",
                      rows.front().second.where, core);
}

}  // namespace generate
