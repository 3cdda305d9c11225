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

Programs::Programs(std::vector<qemu::MeasuredCall> calls, const std::string& core, std::filesystem::path cores_folder,
                   PredictCalls predict)
    : calls_(std::move(calls)),
      of_the_rows_(core.empty()),
      cores_folder_(std::move(cores_folder)),
      predict_(std::move(predict)) {
    std::set<std::string> cores;
    for (const qemu::MeasuredCall& call : calls_) {
        cores.insert(of_the_rows_ ? call.core : core);
    }
    cores_.assign(cores.begin(), cores.end());
}

Question Programs::question() const {
    const auto predicted = predict_({{of_the_rows_ ? "" : cores_.front()}}).front();
    auto prediction = predicted.begin();
    std::vector<qemu::MeasuredCycles> rows;
    for (const qemu::MeasuredCall& call : calls_) {
        const timing::CoreFile core = timing::read_named_core(cores_folder_, of_the_rows_ ? call.core : cores_.front());
        rows.push_back({call.function, code_of(call, core), data_of(call, core), false,
                        static_cast<std::uint32_t>(std::lround(prediction++->instructions * call.per)),
                        call.cycles * call.per, call.line});
        rows.back().program = call.elf.string();
        rows.back().per = call.per;
    }
    return question_about(std::move(rows), cores_, cores_folder_);
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
    std::vector<std::vector<qemu::PredictedCycles>> found;
    for (const std::vector<qemu::PredictedCall>& predicted : predict_(asked)) {
        found.emplace_back();
        auto row = calls_.begin();
        for (const qemu::PredictedCall& call : predicted) {
            const double per = row++->per;
            found.back().push_back({call.cycles * per,
                                    call.low * per,
                                    call.high * per,
                                    0.0,
                                    static_cast<std::uint64_t>(std::llround(call.instructions * per)),
                                    {}});
            std::ranges::transform(call.lost, found.back().back().half_cycles.begin(),
                                   [&](double lost) { return std::llround(2.0 * lost * per); });
        }
    }
    return found;
}

}  // namespace gap::cycles
