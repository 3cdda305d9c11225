#include "bench/run/context.hpp"

#include <fmt/format.h>

#include <ctime>
#include <fstream>

#include "base/build_info.hpp"
#include "base/files.hpp"
#include "base/scratch.hpp"
#include "base/sha256.hpp"
#include "bench/rows/target_fields.hpp"
#include "bench/run/commit.hpp"
#include "bench/run/first_line.hpp"
#include "bench/target/target_build.hpp"
#include "bench/target/target_plan.hpp"
#include "bench/target/target_rows.hpp"
#include "glsum/registry.hpp"

namespace bench {
namespace {

std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) {
            return line.substr(line.find(':') + 2);
        }
    }
    return first_line("uname -m");
}

std::string now() {
    const std::time_t time = std::time(nullptr);
    char text[64];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S%z", std::localtime(&time));
    return text;
}

// "NAME sha256:HASH" of each core, the hash over its file and those that it is based on; "none" without any.
std::string core_files(const qemu::Board& board, const std::vector<std::string>& cores) {
    const base::Scratch scratch;
    std::string text;
    for (const timing::CoreFile& core : timing::cores_of(timing_request(board.cores, cores))) {
        base::write_file(scratch.file("core"), core.text);
        text +=
            fmt::format("{}{} sha256:{}", text.empty() ? "" : ", ", core.name, base::sha256_of(scratch.file("core")));
    }
    return text.empty() ? "none" : text;
}

}  // namespace

Json make_context(Json google, const Sweep& sweep, const std::vector<qemu::Board>& boards) {
    Json context = std::move(google);
    if (context.is_null()) {
        context["date"] = now();
        context["host_name"] = first_line("uname -n");
        context["executable"] = "glsum bench";
        context["library_build_type"] = "release";
    }
    const Commit commit = commit_of(build_info::source_folder);
    context["schema"] = "glsum-results-1";
    context["glsum_version"] = build_info::version;
    context["commit"] = commit.hash;
    context["dirty"] = commit.dirty;
    context["compiler"] = build_info::compiler;
    context["flags"] = build_info::flags;
    context["contraction"] = build_info::contraction;
    context["peer_flags"] = build_info::peer_flags;
    context["cpu"] = cpu_name();
#if defined(GLSUM_SIMD)
    context["simd"] = std::string(glsum::simd_instruction_set());
#endif
    context["core_file"] = boards.empty() ? "none" : core_files(boards.front(), sweep.modelled_cores());
    for (const qemu::Board& board : boards) {
        const auto field = [&](std::string_view name) {
            return target_field(name, *board.machine, &board == boards.data());
        };
        const std::filesystem::path info = board.measure_elf.parent_path() / "build_info.json";
        const TargetBuild target = parse_target_build(base::read_file(info, std::size_t{1} << 20), info.string());
        context[field("target_compiler")] = target.compiler;
        context[field("target_flags")] = target.flags;
        context[field("elf_sha256")] = base::sha256_of(board.measure_elf);
    }
    if (!boards.empty()) {
        context["qemu_version"] = qemu::emulator_version();
        context["target_count_order"] = fmt::format("{}", count_order(sweep));
        context["placement"] = "code below 4 MB, data from 0x20000000 (flat memory)";
    }
    context["weights"] = to_text(sweep.weights);
    Json first_weights = Json::object();
    for (const double order : sweep.orders) {
        first_weights[fmt::format("{}", order)] = rounded_first_weight(sweep.weights, order);
    }
    context["first_weights"] = std::move(first_weights);  // w_0: the derivative is w_0 h^-v S
    std::vector<std::string> taps;
    for (const Length& length : sweep.lengths) {
        taps.push_back(length.text());
    }
    context["sweep"] = {{"kernels", sweep.kernels}, {"peers", sweep.peers},
                        {"orders", sweep.orders},   {"taps", taps},
                        {"signals", sweep.signals}, {"targets", sweep.targets},
                        {"cores", sweep.cores},     {"design_errors", sweep.design_errors}};
    context["n_samples"] = sweep.samples;
    context["seed"] = sweep.seed;
    return context;
}

}  // namespace bench
