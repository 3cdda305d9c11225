#include "qemu/emulate/predicted_calls.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "base/failure.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/foreign_program.hpp"
#include "qemu/emulate/function_time.hpp"
#include "qemu/emulate/timed_program.hpp"

namespace qemu {
namespace {

// A row by one of the variants, and the request's core for it.
struct Asked {
    std::size_t row;
    std::size_t variant;
    std::size_t core;
};

// A function of a program on a board, and what is asked about it.
struct Timed {
    std::filesystem::path elf;
    Function function;
    const base::Machine* machine;
    timing::TimingRequest request;
    std::vector<Asked> asked;
};

// What goes wrong on the way to a row's figure names the row.
template <class Work>
auto for_row(const std::string& name, const MeasuredCall& row, Work work) {
    try {
        return work();
    } catch (const glsum::Failure& failure) {
        throw glsum::Failure(failure.status(), fmt::format("{}:{}: {}", name, row.line, failure.what()));
    }
}

const std::string& core_named(const MeasuredCall& row, const CoreVariant& variant) {
    return variant.core.empty() ? row.core : variant.core;
}

std::size_t core_of(timing::TimingRequest& request, const MeasuredCall& row, const CoreVariant& variant) {
    timing::TimingRequest::Core asked = timing::core_asked_for(core_named(row, variant));
    for (std::size_t c = 0; c < request.cores.size(); ++c) {
        const timing::TimingRequest::Core& core = request.cores[c];
        if (core.name == asked.name && core.file == asked.file && core.code == row.code && core.data == row.data &&
            core.set == variant.set && core.without == variant.without) {
            return c;
        }
    }
    asked.code = row.code;
    asked.data = row.data;
    asked.set = variant.set;
    asked.without = variant.without;
    request.cores.push_back(asked);
    return request.cores.size() - 1;
}

// Everything is looked up before the first emulation.
std::vector<Timed> plan_of(const CallsProgram& program, const std::vector<MeasuredCall>& rows, const std::string& name,
                           const std::vector<CoreVariant>& variants) {
    std::map<std::filesystem::path, std::unique_ptr<Elf>> elves;
    std::map<std::tuple<std::filesystem::path, std::uint32_t, const base::Machine*>, std::size_t> known;
    std::vector<Timed> plan;
    const auto add = [&](std::size_t row_number, std::size_t variant) {
        const MeasuredCall& row = rows[row_number];
        std::unique_ptr<Elf>& elf = elves[row.elf];
        if (!elf) {
            elf = std::make_unique<Elf>(row.elf);
        }
        const base::Machine* const machine =
            &machine_of(timing::core_asked_for(core_named(row, variants[variant])), program.cores_folder);
        check_runs_on_board(*elf, *machine);
        const Function function = elf->function(row.function);
        const auto [at, is_new] = known.emplace(std::tuple(row.elf, function.address, machine), plan.size());
        if (is_new) {
            plan.push_back({row.elf, function, machine, {program.cores_folder.string(), {}}, {}});
        }
        Timed& timed = plan[at->second];
        const std::size_t cores = timed.request.cores.size();
        timed.asked.push_back({row_number, variant, core_of(timed.request, row, variants[variant])});
        if (timed.request.cores.size() > cores) {
            (void)timing::cores_of({program.cores_folder.string(), {timed.request.cores.back()}});
        }
    };
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t v = 0; v < variants.size(); ++v) {
            for_row(name, rows[i], [&] { add(i, v); });
        }
    }
    return plan;
}

}  // namespace

std::vector<std::vector<PredictedCall>> predict_calls(const CallsProgram& program,
                                                      const std::vector<MeasuredCall>& rows, const std::string& name,
                                                      const std::vector<CoreVariant>& variants, unsigned jobs) {
    const std::vector<Timed> plan = plan_of(program, rows, name, variants);
    std::vector<std::vector<PredictedCall>> predicted(variants.size(), std::vector<PredictedCall>(rows.size()));
    base::Progress progress("programs", plan.size());
    base::parallel_for(plan.size(), jobs, [&](std::size_t p) {
        const Timed& timed = plan[p];
        const timing::TimingLog log = for_row(name, rows[timed.asked.front().row], [&] {
            return time_program(program.emulator(*timed.machine), program.plugin, timed.elf, {timed.function.name},
                                {timed.function.address}, timed.request, {}, {})
                .front();
        });
        for (const Asked& asked : timed.asked) {
            const FunctionTime time = function_time(log, asked.core);
            const double per = rows[asked.row].per;
            const auto cycles = [per](std::int64_t half) { return static_cast<double>(half) / 2.0 / per; };
            PredictedCall& call = predicted[asked.variant][asked.row];
            call = {cycles(time.nominal.median),
                    cycles(time.low),
                    cycles(time.high),
                    static_cast<double>(time.instructions.median) / per,
                    {}};
            for (std::size_t e = 0; e < timing::effect_count; ++e) {
                call.lost[e] = cycles(time.lost[e].median);
            }
        }
        progress.advance();
    });
    return predicted;
}

}  // namespace qemu
