#include "qemu/emulate/silicon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <tuple>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/silicon_loops.hpp"
#include "qemu/emulate/timed_program.hpp"
#include "qemu/emulate/watched.hpp"
#include "targets/shared/silicon_calls.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

constexpr std::uint32_t most_taps = 1024;   // of a registered kernel, as targets/firmware/silicon.cpp has memory for
constexpr std::size_t rows_of_a_run = 400;  // of at most 40 bytes: the firmware's plan holds 16 KB

}  // namespace

std::vector<std::vector<PredictedCycles>> predict(const SiliconProgram& program, const std::filesystem::path& file,
                                                  const std::vector<MeasuredCycles>& rows,
                                                  const std::vector<CoreVariant>& variants) {
    const Elf elf(program.elf);
    const std::map<std::string, WatchedKernel> kernels = watched_kernels(elf);
    // Each placement is a core of its own; each kernel and length is run once.
    std::vector<std::pair<std::string, std::string>> placements;
    std::vector<std::pair<std::string, std::uint32_t>> plan;
    std::set<std::uint32_t> entries;
    const auto index_in = [](auto& list, const auto& value) {
        const auto found = std::find(list.begin(), list.end(), value);
        if (found == list.end()) {
            list.push_back(value);
            return list.size() - 1;
        }
        return static_cast<std::size_t>(found - list.begin());
    };
    std::vector<std::pair<std::size_t, std::size_t>> of_row;  // placement, plan
    for (const MeasuredCycles& row : rows) {
        const SiliconLoop* const loop = find_loop(row.kernel);
        const auto kernel = kernels.find(row.kernel);
        if (loop == nullptr && kernel == kernels.end()) {
            throw Failure(Exit::bad_input, fmt::format("{}:{}: kernel: expected one of the registry's that runs on the "
                                                       "target, or a loop of silicon_loops.def; found {}",
                                                       file.string(), row.line, row.kernel));
        }
        const std::uint32_t most = loop != nullptr ? loop->most_taps : most_taps;
        if (row.taps > most) {
            throw Failure(Exit::bad_input, fmt::format("{}:{}: taps: {} takes 1 to {}, found {}", file.string(),
                                                       row.line, row.kernel, most, row.taps));
        }
        entries.insert(loop != nullptr ? address_of(elf, "glsum_silicon_" + row.kernel) : kernel->second.step);
        of_row.emplace_back(index_in(placements, std::pair(row.code, row.data)),
                            index_in(plan, std::pair(row.kernel, row.taps)));
    }
    timing::TimingRequest request;
    request.cores_folder = program.cores_folder.string();
    for (const CoreVariant& variant : variants) {
        for (const auto& [code, data] : placements) {
            timing::TimingRequest::Core core = timing::core_asked_for(variant.core);
            core.code = code == "itcm" ? "itcm" : "flash";
            core.data = data;
            core.instruction_cache = code != "flash";
            core.set = variant.set;
            core.without = variant.without;
            request.cores.push_back(core);
        }
    }
    const std::vector<timing::CoreFile> cores = timing::cores_of(request);

    // Of each row of the plan its last call, in runs of as many rows as the firmware reads at once.
    std::vector<timing::TimedCall> settled;
    while (settled.size() < plan.size()) {
        const std::size_t end = std::min(plan.size(), settled.size() + rows_of_a_run);
        const base::Scratch scratch;
        std::string text;
        for (std::size_t i = settled.size(); i < end; ++i) {
            text += fmt::format("{}{} {}", text.empty() ? "" : "\n", plan[i].first, plan[i].second);
        }
        std::ofstream out(scratch.file("plan"));
        out << text;
        if (!out.flush()) {
            throw Failure(Exit::check_failed, fmt::format("{}: cannot write", scratch.file("plan").string()));
        }
        const auto logs = time_program(program.emulator, program.plugin, program.elf, {scratch.file("plan").string()},
                                       {entries.begin(), entries.end()}, request, marks_of(elf), {});
        if (logs.size() != end - settled.size()) {
            throw Failure(Exit::check_failed, fmt::format("{}: {} rows were seen, {} expected", program.elf.string(),
                                                          logs.size(), end - settled.size()));
        }
        for (const timing::TimingLog& log : logs) {
            std::uint64_t calls = 0;
            for (const timing::TimedRun& run : log.runs) {
                calls += run.calls;
            }
            if (calls != firmware::silicon_calls) {
                throw Failure(Exit::check_failed,
                              fmt::format("{}: {} calls of {} were seen, {} expected", program.elf.string(), calls,
                                          plan[settled.size()].first, firmware::silicon_calls));
            }
            if (!log.unknown.empty()) {
                throw Failure(Exit::check_failed,
                              fmt::format("{}: the timing model does not know the encoding at {:#010x}",
                                          program.elf.string(), log.unknown.begin()->first));
            }
            settled.push_back(log.runs.back().call);
        }
    }
    std::vector<std::vector<PredictedCycles>> predictions(variants.size());
    for (std::size_t v = 0; v < variants.size(); ++v) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto [placement, planned] = of_row[i];
            const std::size_t core = v * placements.size() + placement;
            const timing::CoreTime& time = settled[planned].cores[core];
            const timing::Figures& figures = cores[core].sets[0].figures;
            const auto beside = static_cast<double>(figures.measurement_counter_reads +
                                                    (rows[i].maintenance ? figures.measurement_maintenance : 0));
            const auto cycles = [&](std::int64_t half) { return static_cast<double>(half) / 2.0 + beside; };
            const auto [low, high] = std::minmax_element(time.half_cycles.begin(), time.half_cycles.end());
            predictions[v].push_back({cycles(time.half_cycles[0]), cycles(*low), cycles(*high), beside,
                                      settled[planned].instructions, time.losses});
        }
    }
    return predictions;
}

FittedLine fit_line(const std::vector<double>& taps, const std::vector<double>& cycles) {
    const auto n = static_cast<double>(taps.size());
    double sx = 0;
    double sy = 0;
    for (std::size_t i = 0; i < taps.size(); ++i) {
        sx += taps[i] / n;
        sy += cycles[i] / n;
    }
    double sxx = 0;
    double sxy = 0;
    for (std::size_t i = 0; i < taps.size(); ++i) {
        sxx += (taps[i] - sx) * (taps[i] - sx);
        sxy += (taps[i] - sx) * (cycles[i] - sy);
    }
    const double slope = sxx > 0 ? sxy / sxx : 0;
    return {slope, sy - slope * sx};
}

}  // namespace qemu
