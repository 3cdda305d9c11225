#include "bench/generate/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/progress.hpp"
#include "base/scratch.hpp"
#include "bench/rows/row.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/catalogue.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/watched.hpp"

namespace generate {
namespace {

using glsum::Exit;
using glsum::Failure;

// Runs a command; what it says is thrown when it fails.
void run(const std::string& command) {
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    std::string said;
    char part[512];
    while (pipe != nullptr && std::fgets(part, sizeof part, pipe) != nullptr) {
        said += said.size() < 4000 ? part : "";
    }
    const int status = pipe != nullptr ? pclose(pipe) : -1;
    if (status != 0) {
        throw Failure(Exit::check_failed, fmt::format("the target's compiler refuses: {}\n{}", command, said));
    }
}

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
    }
    return flags;
}

std::string upper(std::string word) {
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::toupper(c); });
    return word;
}

const char* sample_type(const glsum::CatalogueEntry& kernel) {
    if (kernel.floating_point) {
        return kernel.sample_bytes == sizeof(double) ? "double" : "float";
    }
    return kernel.sample_bytes == sizeof(std::int32_t) ? "int32_t" : "int16_t";
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream out(path, std::ios::binary);
    out << text;
    if (!out.flush()) {
        throw Failure(Exit::bad_input, fmt::format("{}: cannot write", path.string()));
    }
}

std::filesystem::path link(const std::vector<Spec>& specs, const qemu::Board& board, const base::Scratch& scratch) {
    const std::filesystem::path source = build_info::source_folder;
    const std::filesystem::path targets = source / "targets";
    const std::string flags = target_flags(board);
    if (std::system("command -v arm-none-eabi-gcc >/dev/null 2>&1") != 0) {
        throw Failure(Exit::missing, "arm-none-eabi-gcc: not found (Debian package gcc-arm-none-eabi)");
    }
    const std::filesystem::path c_file = scratch.file("counted.c");
    const std::filesystem::path elf = scratch.file("verify.elf");
    write(c_file, counted_source(specs));
    // Without section anchors: a header is to be compiled as it is alone, not beside the tables of others.
    run(
        fmt::format("arm-none-eabi-gcc -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Werror -ffunction-sections "
                    "-fno-section-anchors{} -c "
                    "'{}' -o '{}'",
                    flags, c_file.string(), scratch.file("counted.o").string()));
    run(fmt::format(
        "arm-none-eabi-g++ -std=c++20 -fno-exceptions -fno-rtti{} -I'{}' -nostartfiles -Wl,--gc-sections "
        "-T '{}' -T '{}' '{}' '{}' '{}' '{}' '{}' -lm -o '{}'",
        flags,
        source.string() + "' -I'" + targets.string() + "' -I'" + (targets / "firmware").string() + "' -I'" +
            (source / "kernels").string(),
        (board.folder() / "memory.ld").string(), (targets / "cortex-m7" / "sections.ld").string(),
        (targets / "firmware" / "verify.cpp").string(), (targets / "firmware" / "verify_calls.cpp").string(),
        (targets / "firmware" / "marks.S").string(), scratch.file("counted.o").string(),
        (board.measure_elf.parent_path() / "libboard.a").string(), elf.string()));
    return elf;
}

}  // namespace

bool Verified::good() const {
    const glsum::CatalogueEntry* const entry = glsum::find_kernel(kernel);
    const bool in_software = entry != nullptr && entry->in_double;
    const double place = in_software ? std::max(place_share * kernel_cycles, place_cycles) : 0.0;
    const double saved = in_software ? std::max(saved_share * kernel_instructions, saved_instructions) : 0.0;
    return first_wrong == 0 && header_instructions <= kernel_instructions + saved &&
           header_cycles <= kernel_cycles + place;
}

std::string counted_source(const std::vector<Spec>& specs) {
    std::string text =
        "#include <stdint.h>\nvoid glsum_make_calls(unsigned taps, unsigned software_double, void (*make)(unsigned "
        "call));\n";
    std::string entries;
    for (std::size_t i = 0; i < specs.size(); ++i) {
        const glsum::CatalogueEntry& kernel = bench::facts_of(specs[i].kernel);
        const std::string format(kernel.format);
        const std::string name = specs[i].prefix + "_" + format;
        const firmware::TimedCalls calls = qemu::timed_calls(specs[i].kernel, specs[i].taps);
        text += fmt::format(R"(#define {7}_TABLE_ATTRIBUTES __attribute__((section(".data.tables"), aligned(8)))
#include "{0}.h"
typedef {4} sample_{0};
typedef {5} output_{0};
output_{0} count_{0}({1}_instance *S, sample_{0} x);
__attribute__((noipa, flatten)) output_{0} count_{0}({1}_instance *S, sample_{0} x)
{{
    return {0}_step_{2}(S, x);
}}
static {1}_instance line_{0};
static void call_{0}(unsigned k)
{{
    (void)count_{0}(&line_{0}, {1}_check_input[k % (sizeof {1}_check_input / sizeof {1}_check_input[0])]);
    __asm__ volatile(""); /* or the call would become a jump, which is no call to the plugin */
}}
static uint32_t verify_{0}(void)
{{
    const uint32_t wrong = {0}_self_check_{2}(&line_{0});
    glsum_make_calls({3}U, {6}U, call_{0});
    return wrong;
}}
)",
                            specs[i].prefix, name, format, specs[i].taps, sample_type(kernel),
                            kernel.floating_point ? sample_type(kernel) : "int32_t", calls.software_double ? 1 : 0,
                            upper(name));
        entries += fmt::format("    verify_{},\n", specs[i].prefix);
    }
    return text + "static uint32_t (*const entries[])(void) = {\n" + entries +
           "};\nextern const unsigned glsum_verified_count;\nunsigned glsum_verify(unsigned number);\n"
           "const unsigned glsum_verified_count = sizeof entries / sizeof entries[0];\n"
           "unsigned glsum_verify(unsigned number)\n{\n    return (unsigned)entries[number]();\n}\n";
}

std::map<std::uint32_t, SteadyCalls> steady_calls_of(const qemu::CallLog& log,
                                                     const std::map<std::uint32_t, std::size_t>& taps) {
    std::map<std::uint32_t, SteadyCalls> result;
    std::map<std::uint32_t, std::uint64_t> seen;
    for (const qemu::CallRun& run : log.runs) {
        SteadyCalls& mean = result[run.entry];
        const std::uint64_t from = 1 + taps.at(run.entry);
        const std::uint64_t before = seen[run.entry];
        if (before == 0) {
            mean.first_instructions = run.counts.instructions;
        }
        seen[run.entry] += run.calls;
        const std::uint64_t begin = std::max(before, from);
        const std::uint64_t end = std::min(before + run.calls, from + SteadyCalls::count);
        if (begin < end) {
            const double share = static_cast<double>(end - begin) / static_cast<double>(SteadyCalls::count);
            mean.instructions += share * static_cast<double>(run.counts.instructions);
            mean.stores += share * static_cast<double>(run.counts.stores);
        }
    }
    return result;
}

std::vector<Verified> verify_on_target(const std::vector<Spec>& wanted, const qemu::Board& board,
                                       const timing::TimingRequest& timing) {
    const base::Scratch scratch;
    std::vector<Spec> specs = wanted;
    std::vector<qemu::PlannedRow> plan;
    for (std::size_t i = 0; i < specs.size(); ++i) {
        specs[i].prefix = fmt::format("k{}", i);
        write(scratch.file((specs[i].prefix + ".h").c_str()), make_header(specs[i]));
        const glsum::Design design = bench::design_of(
            specs[i].kernel, specs[i].order,
            bench::length_of(specs[i].kernel, specs[i].order, specs[i].taps, specs[i].horizon), specs[i].horizon);
        plan.push_back({specs[i].kernel,
                        specs[i].order,
                        specs[i].taps,
                        0,
                        qemu::calls_to_measure(specs[i].kernel, specs[i].taps),
                        {design.modes.begin(), design.modes.end()},
                        design.blocks});
    }
    const std::filesystem::path path = link(specs, board, scratch);
    base::Progress progress("emulated Cortex-M7", 2 * specs.size());
    const auto kernels = qemu::measure(
        board, plan, {check_signal()}, [&] { progress.advance(); }, qemu::Counting::blocks, timing);

    const qemu::Elf elf(path);
    std::map<std::uint32_t, std::size_t> taps;
    std::vector<std::uint32_t> entries;
    std::string watch;
    for (const Spec& spec : specs) {
        entries.push_back(elf.symbol("count_" + spec.prefix).value());
        taps[entries.back()] = spec.taps;
        watch += fmt::format("{}\n", entries.back());
    }
    write(scratch.file("watch"), watch);
    const qemu::Marks marks = qemu::marks_of(elf);
    write(scratch.file("marks"), fmt::format("{} {} {}\n", marks.row, marks.on, marks.off));
    std::ostringstream request;
    timing::write_timing_request(request, timing);
    write(scratch.file("request"), request.str());
    std::vector<Verified> all;
    qemu::emulate(
        board.emulator, path, {},
        fmt::format("{},watch={},out={},stream=off,marks={},timing={},times={}", board.plugin.string(),
                    scratch.file("watch").string(), scratch.file("calls").string(), scratch.file("marks").string(),
                    scratch.file("request").string(), scratch.file("times").string()),
        [&](const std::string& line) {
            std::istringstream words(line);
            std::string kind;
            std::size_t number = 0;
            std::uint32_t wrong = 0;
            if (words >> kind >> number >> wrong && kind == "row" && number == all.size() && number < specs.size()) {
                all.push_back({specs[number].kernel, specs[number].taps, wrong, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
                progress.advance();
            }
        });
    if (all.size() != specs.size()) {
        throw Failure(Exit::check_failed,
                      fmt::format("the firmware answered for {} headers of {} and stopped", all.size(), specs.size()));
    }
    std::ifstream log_file(scratch.file("calls"));
    const auto counted = steady_calls_of(qemu::read_call_log(log_file), taps);
    std::ifstream times(scratch.file("times"));
    for (std::size_t i = 0; i < all.size(); ++i) {
        const SteadyCalls& header = counted.at(entries[i]);
        const firmware::TimedCalls calls = qemu::timed_calls(specs[i].kernel, specs[i].taps);
        all[i].kernel_cycles = kernels[i].cores.at(0).cycles;
        all[i].header_cycles =
            qemu::modelled_calls(timing::read_timing_log(times), calls, calls.calls(), timing.cores.size(),
                                 header.first_instructions, "the header of " + specs[i].kernel)
                .at(0)
                .cycles;
        all[i].kernel_instructions = kernels[i].instructions;
        all[i].kernel_stores = kernels[i].stores;
        all[i].header_instructions = header.instructions;
        all[i].header_stores = header.stores;
    }
    return all;
}

std::string to_table(const std::vector<Verified>& all, const std::string& core) {
    std::string text =
        fmt::format("  {:<26} {:>5}  {:<14} {:^32}  {:^30}\n", "", "", "", "instructions", "modelled cycles");
    text += fmt::format("  {:<26} {:>5}  {:<14} {:>11} {:>11} {:>8}  {:>10} {:>10} {:>8}\n", "kernel", "taps", "bits",
                        "kernel", "header", "ratio", "kernel", "header", "ratio");
    for (const Verified& one : all) {
        text += fmt::format(
            "  {:<26} {:>5}  {:<14} {:>11.1f} {:>11.1f} {:>8.4f}  {:>10.1f} {:>10.1f} {:>8.4f}{}\n", one.kernel,
            one.taps, one.first_wrong == 0 ? "the kernel's" : fmt::format("differ at {}", one.first_wrong),
            one.kernel_instructions, one.header_instructions, one.header_instructions / one.kernel_instructions,
            one.kernel_cycles, one.header_cycles, one.header_cycles / one.kernel_cycles, one.good() ? "" : "  FAILED");
    }
    return text + fmt::format(
                      "\n  a sample on the emulated Cortex-M7, of the registered kernel and of the generated header; "
                      "cycles of "
                      "the timing model for {}\n",
                      core);
}

}  // namespace generate
