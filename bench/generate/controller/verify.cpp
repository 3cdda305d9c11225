#include "bench/generate/controller/verify.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/generate/target_program.hpp"
#include "bench/generate/verify.hpp"
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
        throw Failure(Exit::check_failed, "the compiled controller: expected a number, found that it stopped");
    }
    return static_cast<std::uint32_t>(number);
}

}  // namespace

CheckedBits check_bits_here(const WrittenController& controller) {
    if (std::system("command -v cc >/dev/null 2>&1") != 0) {
        throw Failure(Exit::missing, "cc: not found, expected this machine's C compiler (Debian package gcc)");
    }
    const base::Scratch scratch;
    write_file(scratch.file((controller.prefix + ".h").c_str()), controller.text);
    write_file(scratch.file("check.c"), check_source({controller}) +
                                            "#include <stdio.h>\nint main(void)\n{\n"
                                            "    return printf(\"%lu\\n\", (unsigned "
                                            "long)entries[0]()) > 0 ? 0 : 1;\n}\n");
    const std::string program = scratch.file("check").string();
    compile(fmt::format("cc -std=c99 -O2 -Wall -Wextra -Wpedantic -Wconversion -Werror '{}' -lm -o '{}'",
                        scratch.file("check.c").string(), program),
            "this machine's C compiler");
    return {"here, compiled by cc", check_record().setpoint.size(), number_from(program)};
}

std::vector<OnTarget> check_on_target(const std::vector<WrittenController>& controllers, const qemu::Board& board,
                                      const timing::TimingRequest& timing) {
    const base::Scratch scratch;
    std::vector<std::string> functions;
    for (const WrittenController& controller : controllers) {
        write_file(scratch.file((controller.prefix + ".h").c_str()), controller.text);
        functions.push_back("count_" + controller.prefix);
    }
    const std::filesystem::path path = link_for_target(target_source(controllers), board, scratch);
    const TargetRun run =
        run_on_target(path, functions, answers_a_controller * controllers.size(), board, timing, scratch, [] {});
    std::map<std::uint32_t, std::size_t> settled;
    for (const std::uint32_t entry : run.entries) {
        settled[entry] = controller_calls.taps;
    }
    const auto counted = steady_calls_of(run.counts, settled);
    const qemu::Elf elf(path);
    std::vector<OnTarget> all;
    for (std::size_t i = 0; i < controllers.size(); ++i) {
        const SteadyCalls& step = counted.at(run.entries[i]);
        const qemu::ModelledCall call =
            qemu::modelled_calls(run.timings[i], controller_calls, controller_calls.calls(), timing.cores.size(),
                                 step.first_instructions, controllers[i].prefix)
                .at(0);
        const std::uint32_t* const answers = &run.answers[answers_a_controller * i];
        all.push_back({{"on the emulated Cortex-M7", check_record().setpoint.size(), answers[0]},
                       {call.cycles, call.low, call.high, step.instructions,
                        elf.end_of_function(run.entries[i]) - run.entries[i], answers[2], answers[1]}});
    }
    return all;
}

ControllerSpec whole_orders(const ControllerSpec& spec) {
    ControllerSpec whole = spec;
    whole.controller.gains.integral_order = 1.0;
    whole.controller.gains.derivative_order = 1.0;
    return whole;
}

std::string to_text(const CheckedBits& checked) {
    const std::string found = checked.first_wrong == 0 ? "the library's"
                              : checked.first_wrong == self_check_failed
                                  ? "those of the self-check are others"
                                  : fmt::format("others from step {} on", checked.first_wrong);
    return fmt::format("bits of {} steps and of the self-check, {}: {}", checked.steps, checked.where, found);
}

}  // namespace generate
