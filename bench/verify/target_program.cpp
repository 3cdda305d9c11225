#include "bench/verify/target_program.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "bench/rows/row.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/watched.hpp"

namespace generate {
namespace {

using glsum::Exit;
using glsum::Failure;

// The flags of the firmware that say for which core, how hard to optimise, and where functions begin. Not its
// -ffp-contract: the header must hold without.
std::string target_flags(const qemu::Board& board) {
    const std::filesystem::path path = board.measure_elf.parent_path() / "build_info.json";
    std::ifstream file(path);
    const bench::Json info = bench::Json::parse(file, nullptr, false);
    if (!info.is_object() || !info.contains("flags") || !info["flags"].is_string()) {
        throw Failure(Exit::missing, fmt::format("{}: expected the flags of the firmware", path.string()));
    }
    std::istringstream words(info["flags"].get<std::string>());
    std::string flags;
    for (std::string word; words >> word;) {
        flags += word.starts_with("-m") || word.starts_with("-O") || word.starts_with("-falign") ? " " + word : "";
        flags += word == "-mcpu=cortex-m4" ? " -DGLSUM_CORTEX_M4" : "";  // as its user says
    }
    return flags;
}

}  // namespace

void write_file(const std::filesystem::path& path, const std::string& text) {
    std::ofstream out(path, std::ios::binary);
    out << text;
    if (!out.flush()) {
        throw Failure(Exit::bad_input, fmt::format("{}: cannot write", path.string()));
    }
}

void compile(const std::string& command, const std::string& who) {
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    std::string said;
    char part[512];
    while (pipe != nullptr && std::fgets(part, sizeof part, pipe) != nullptr) {
        said += said.size() < 4000 ? part : "";
    }
    const int status = pipe != nullptr ? pclose(pipe) : -1;
    if (status != 0) {
        throw Failure(Exit::check_failed, fmt::format("{} refuses: {}\n{}", who, command, said));
    }
}

std::filesystem::path link_for_target(const std::string& code, const qemu::Board& board, const base::Scratch& scratch) {
    const std::filesystem::path source = build_info::source_folder;
    const std::filesystem::path targets = source / "targets";
    const std::string flags = target_flags(board);
    if (std::system("command -v arm-none-eabi-gcc >/dev/null 2>&1") != 0) {
        throw Failure(Exit::missing, "arm-none-eabi-gcc: not found (Debian package gcc-arm-none-eabi)");
    }
    const std::filesystem::path c_file = scratch.file("counted.c");
    const std::filesystem::path elf = scratch.file("verify.elf");
    write_file(c_file, code);
    // Without section anchors: a header is to be compiled as it is alone, not beside the tables of others.
    compile(fmt::format("arm-none-eabi-gcc -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Werror -ffunction-sections "
                        "-fno-section-anchors{} -c "
                        "'{}' -o '{}'",
                        flags, c_file.string(), scratch.file("counted.o").string()),
            "the target's compiler");
    compile(fmt::format(
                "arm-none-eabi-g++ -std=c++20 -fno-exceptions -fno-rtti{} -I'{}' -nostartfiles -Wl,--gc-sections "
                "-T '{}' -T '{}' '{}' '{}' '{}' '{}' '{}' -lm -o '{}'",
                flags,
                source.string() + "' -I'" + targets.string() + "' -I'" + (targets / "firmware").string() + "' -I'" +
                    (source / "kernels").string(),
                (board.folder() / "memory.ld").string(), (targets / "cortex-m7" / "sections.ld").string(),
                (targets / "firmware" / "verify.cpp").string(), (targets / "firmware" / "verify_calls.cpp").string(),
                (targets / "firmware" / "marks.S").string(), scratch.file("counted.o").string(),
                (board.measure_elf.parent_path() / "libboard.a").string(), elf.string()),
            "the target's compiler");
    return elf;
}

TargetRun run_on_target(const std::filesystem::path& path, const std::vector<std::string>& functions,
                        std::size_t answers, const qemu::Board& board, const timing::TimingRequest& timing,
                        const base::Scratch& scratch, const std::function<void()>& done) {
    const qemu::Elf elf(path);
    TargetRun run;
    std::string watch;
    for (const std::string& function : functions) {
        run.entries.push_back(qemu::address_of(elf, function));
        watch += fmt::format("{}\n", run.entries.back());
    }
    write_file(scratch.file("watch"), watch);
    const qemu::Marks marks = qemu::marks_of(elf);
    write_file(scratch.file("marks"), fmt::format("{} {} {}\n", marks.row, marks.on, marks.off));
    std::ostringstream request;
    timing::write_timing_request(request, timing);
    write_file(scratch.file("request"), request.str());
    qemu::emulate(
        board.emulator, path, {},
        fmt::format("{},watch={},out={},stream=off,marks={},timing={},times={}", board.plugin.string(),
                    scratch.file("watch").string(), scratch.file("calls").string(), scratch.file("marks").string(),
                    scratch.file("request").string(), scratch.file("times").string()),
        [&](const std::string& line) {
            std::istringstream words(line);
            std::string kind;
            std::size_t number = 0;
            std::uint32_t answer = 0;
            if (words >> kind >> number >> answer && kind == "row" && number == run.answers.size() &&
                number < answers) {
                run.answers.push_back(answer);
                done();
            }
        });
    if (run.answers.size() != answers) {
        throw Failure(Exit::check_failed,
                      fmt::format("the firmware gave {} answers of {} and stopped", run.answers.size(), answers));
    }
    std::ifstream counts(scratch.file("calls"));
    run.counts = qemu::read_call_log(counts);
    std::ifstream times(scratch.file("times"));
    for (std::size_t i = 0; i < functions.size(); ++i) {
        run.timings.push_back(timing::read_timing_log(times));
    }
    return run;
}

}  // namespace generate
