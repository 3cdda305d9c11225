#include "gap/cycles/programs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "qemu/timing/core_file.hpp"

namespace gap::cycles {
namespace {

// As rows of our kernels say it: what a cache stands before is no longer on the bus.
std::string code_of(const qemu::MeasuredCall& call, const timing::CoreFile& core) {
    const timing::CodePlace place = call.code.empty() ? core.placement.code : timing::code_place_named(call.code);
    if (place == timing::CodePlace::itcm) {
        return "itcm";
    }
    return fmt::format("{}{}", place == timing::CodePlace::axi ? "axi" : "flash",
                       core.sets.front().figures.cache_instruction_bytes > 0 ? "_cached" : "");
}

std::string data_of(const qemu::MeasuredCall& call, const timing::CoreFile& core) {
    const timing::DataPlace place = call.data.empty() ? core.placement.data : timing::data_place_named(call.data);
    return place == timing::DataPlace::dtcm ? "dtcm" : "axi";
}

}  // namespace

Programs::Programs(qemu::CallsProgram program, std::vector<qemu::MeasuredCall> calls, const std::string& core,
                   std::string name, unsigned jobs)
    : program_(std::move(program)),
      calls_(std::move(calls)),
      of_the_rows_(core.empty()),
      name_(std::move(name)),
      jobs_(jobs) {
    std::set<std::string> cores;
    for (const qemu::MeasuredCall& call : calls_) {
        cores.insert(of_the_rows_ ? call.core : core);
    }
    cores_.assign(cores.begin(), cores.end());
}

Question Programs::question() const {
    const auto predicted =
        qemu::predict_calls(program_, calls_, name_, {{of_the_rows_ ? "" : cores_.front()}}, jobs_).front();
    std::vector<qemu::MeasuredCycles> rows;
    for (std::size_t i = 0; i < calls_.size(); ++i) {
        const qemu::MeasuredCall& call = calls_[i];
        const timing::CoreFile core =
            timing::read_named_core(program_.cores_folder, of_the_rows_ ? call.core : cores_.front());
        rows.push_back({call.function, code_of(call, core), data_of(call, core), false,
                        static_cast<std::uint32_t>(std::lround(predicted[i].instructions * call.per)),
                        call.cycles * call.per, call.line});
        rows.back().program = call.elf.string();
        rows.back().per = call.per;
    }
    return question_about(std::move(rows), cores_, program_.cores_folder);
}

std::vector<std::vector<qemu::PredictedCycles>> Programs::predict(
    const std::vector<qemu::CoreVariant>& variants) const {
    // The judged cores go by one name in the question.
    const std::string judged = name_of_cores(cores_);
    std::vector<qemu::CoreVariant> asked = variants;
    for (qemu::CoreVariant& variant : asked) {
        if (of_the_rows_ && variant.core == judged) {
            variant.core.clear();
        }
    }
    const auto predicted = qemu::predict_calls(program_, calls_, name_, asked, jobs_);
    std::vector<std::vector<qemu::PredictedCycles>> found(variants.size());
    for (std::size_t v = 0; v < variants.size(); ++v) {
        for (std::size_t i = 0; i < calls_.size(); ++i) {
            const qemu::PredictedCall& call = predicted[v][i];
            const double per = calls_[i].per;
            found[v].push_back({call.cycles * per,
                                call.low * per,
                                call.high * per,
                                0.0,
                                static_cast<std::uint64_t>(std::llround(call.instructions * per)),
                                {}});
            for (std::size_t e = 0; e < timing::effect_count; ++e) {
                found[v].back().half_cycles[e] = std::llround(2.0 * call.lost[e] * per);
            }
        }
    }
    return found;
}

}  // namespace gap::cycles
