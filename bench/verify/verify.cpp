#include "bench/verify/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/progress.hpp"
#include "base/scratch.hpp"
#include "bench/choose/counted_order.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/texts/text.hpp"
#include "bench/verify/target_program.hpp"
#include "glsum/catalogue.hpp"

namespace generate {
namespace {

const char* sample_type(const glsum::CatalogueEntry& kernel) {
    if (kernel.floating_point) {
        return kernel.sample_bytes == sizeof(double) ? "double" : "float";
    }
    return kernel.sample_bytes == sizeof(std::int32_t) ? "int32_t" : "int16_t";
}

}  // namespace

bool Verified::good() const {
    const glsum::CatalogueEntry* const entry = glsum::find_kernel(kernel);
    const bool in_software = entry != nullptr && entry->in_double;
    const double place = in_software ? std::max(place_share * kernel_cycles, place_cycles) : 0.0;
    const double saved = in_software ? std::max(saved_share * kernel_instructions, saved_instructions)
                                     : spare_share * kernel_instructions;
    return first_wrong == 0 && header_instructions <= kernel_instructions + saved &&
           header_cycles <= kernel_cycles + place + (single_issue ? kept_share * kernel_cycles : 0.0);
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
        write_file(scratch.file((specs[i].prefix + ".h").c_str()), make_header(specs[i]));
        const double order = choose::CountedOrder(specs[i].order, specs[i].fitted.has_value()).of(specs[i].kernel);
        const glsum::Design design = bench::design_of(specs[i].kernel, order, length_of(specs[i]), specs[i].horizon);
        plan.push_back({specs[i].kernel,
                        order,
                        specs[i].taps,
                        0,
                        qemu::calls_to_measure(specs[i].kernel, specs[i].taps),
                        {design.modes.begin(), design.modes.end()},
                        design.blocks});
    }
    const std::filesystem::path path = link_for_target(counted_source(specs), board, scratch);
    base::Progress progress(board.name(), 2 * specs.size());
    const auto kernels = qemu::measure(
        board, plan, {check_signal()}, [&] { progress.advance(); }, qemu::Counting::blocks, timing);
    std::vector<std::string> functions;
    for (const Spec& spec : specs) {
        functions.push_back("count_" + spec.prefix);
    }
    const TargetRun run =
        run_on_target(path, functions, functions.size(), board, timing, scratch, [&] { progress.advance(); });
    std::map<std::uint32_t, std::size_t> taps;
    for (std::size_t i = 0; i < specs.size(); ++i) {
        taps[run.entries[i]] = specs[i].taps;
    }
    const auto counted = steady_calls_of(run.counts, taps);
    std::vector<Verified> all;
    for (std::size_t i = 0; i < specs.size(); ++i) {
        const SteadyCalls& header = counted.at(run.entries[i]);
        const firmware::TimedCalls calls = qemu::timed_calls(specs[i].kernel, specs[i].taps);
        Verified one{specs[i].kernel, specs[i].taps, run.answers[i], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        one.kernel_cycles = kernels[i].cores.at(0).cycles;
        one.header_cycles = qemu::modelled_calls(run.timings[i], calls, calls.calls(), timing.cores.size(),
                                                 header.first_instructions, "the header of " + specs[i].kernel)
                                .at(0)
                                .cycles;
        one.single_issue = board.machine->issues_a_cycle == 1;
        one.kernel_instructions = kernels[i].instructions;
        one.kernel_stores = kernels[i].stores;
        one.header_instructions = header.instructions;
        one.header_stores = header.stores;
        all.push_back(one);
    }
    return all;
}

std::string to_table(const std::vector<Verified>& all, const std::string& core, const qemu::Board& board) {
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
                      "\n  a sample on the {}, of the registered kernel and of the generated header; cycles of "
                      "the timing model for {}\n",
                      board.name(), core);
}

}  // namespace generate
