#include "qemu/emulate/function_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/failure.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

// One quantity of a function, in both programs.
struct Quantity {
    const char* name;
    double before;
    double now;
};

std::vector<Quantity> quantities(const GatedFunction& before, const GatedFunction& now) {
    return {
        {"cycles", before.cycles_median, now.cycles_median},
        {"worst", before.cycles_max, now.cycles_max},
        {"instructions", static_cast<double>(before.instructions_median), static_cast<double>(now.instructions_median)},
        {"most instructions", static_cast<double>(before.instructions_max), static_cast<double>(now.instructions_max)},
        {"code bytes", static_cast<double>(before.code_bytes), static_cast<double>(now.code_bytes)},
        {"stack bytes", static_cast<double>(before.stack_bytes), static_cast<double>(now.stack_bytes)}};
}

// "load_use +12, single_issue -1": the largest first.
std::string lost_text(const std::map<std::string, double>& before, const std::map<std::string, double>& now) {
    std::map<std::string, double> moved = now;
    for (const auto& [cause, lost] : before) {
        moved[cause] -= lost;
    }
    std::vector<std::pair<std::string, double>> sorted(moved.begin(), moved.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return std::abs(a.second) > std::abs(b.second); });
    std::string text;
    for (const auto& [cause, by] : sorted) {
        if (by != 0.0) {
            text += fmt::format("{}{} {:+}", text.empty() ? "" : ", ", cause, by);
        }
    }
    return text;
}

std::optional<FunctionChange> change_of(const GatedFunction& before, const GatedFunction& now) {
    if (before.calls == 0 || now.calls == 0) {
        if ((before.calls == 0) == (now.calls == 0) && before.code_bytes == now.code_bytes) {
            return std::nullopt;
        }
        const bool gone = before.calls > 0 && now.calls == 0;
        return FunctionChange{now.name,
                              gone || (before.calls == 0 && now.calls == 0 && now.code_bytes > before.code_bytes),
                              gone            ? "no longer called"
                              : now.calls > 0 ? fmt::format("called now: cycles {}", now.cycles_median)
                                              : fmt::format("code bytes {} -> {}", before.code_bytes, now.code_bytes)};
    }
    FunctionChange change{now.name, false, ""};
    for (const Quantity& one : quantities(before, now)) {
        if (one.before != one.now) {
            change.worse = change.worse || one.now > one.before;
            change.text += fmt::format("{}{} {} -> {} ({:+})", change.text.empty() ? "" : ", ", one.name, one.before,
                                       one.now, one.now - one.before);
        }
    }
    if (const std::string lost = lost_text(before.stalls, now.stalls); !lost.empty()) {
        change.text += (change.text.empty() ? "lost to: " : "; lost to: ") + lost;
    }
    if (!change.text.empty() && before.instructions_median == now.instructions_median &&
        before.instructions_max == now.instructions_max && before.code_bytes == now.code_bytes) {
        change.text += "; as many instructions: by where it lies, or what runs before it";
    }
    return change.text.empty() ? std::nullopt : std::optional(change);
}

}  // namespace

GatedFunction gated_function(const Function& function, const Elf& elf, const std::optional<FunctionTime>& time) {
    GatedFunction gated;
    gated.name = function.name;
    gated.code_bytes = function.bytes;
    if (!time) {
        return gated;
    }
    gated.calls = time->calls;
    gated.instructions_median = time->instructions.median;
    gated.instructions_max = time->instructions.max;
    gated.cycles_median = in_cycles(time->nominal.median);
    gated.cycles_max = in_cycles(time->nominal.max);
    gated.low = in_cycles(time->low);
    gated.high = in_cycles(time->high);
    gated.stack_bytes = time->stack_bytes;
    std::map<std::uint32_t, std::uint32_t> reached{{function.address, function.bytes}};
    for (const auto& [address, spot] : time->hot) {
        if (const Function* const holder = elf.function_at(address)) {
            reached.emplace(holder->address, holder->bytes);
        }
    }
    gated.code_bytes = 0;
    for (const auto& [address, bytes] : reached) {
        gated.code_bytes += bytes;
    }
    for (std::size_t e = 0; e < time->lost.size(); ++e) {
        if (time->lost[e].median != 0) {
            gated.stalls[std::string(timing::effect_names[e])] = in_cycles(time->lost[e].median);
        }
    }
    if (time->in_double.median != 0) {
        gated.stalls[std::string(timing::double_in_software)] = in_cycles(time->in_double.median);
    }
    return gated;
}

std::vector<FunctionChange> changes(const GatedProgram& before, const GatedProgram& now) {
    if (before.core_sha256 != now.core_sha256) {
        throw Failure(Exit::not_comparable,
                      fmt::format("the baseline was modelled on {}, this on {}{}: the cycles of two cores cannot be "
                                  "compared",
                                  before.core, now.core,
                                  before.core == now.core ? ", whose core file or placement is another" : ""));
    }
    std::map<std::string, std::pair<const GatedFunction*, const GatedFunction*>> pairs;
    for (const GatedFunction& one : before.functions) {
        pairs[one.name].first = &one;
    }
    for (const GatedFunction& one : now.functions) {
        pairs[one.name].second = &one;
    }
    std::vector<FunctionChange> found;
    for (const auto& [name, pair] : pairs) {
        if (pair.first == nullptr) {
            found.push_back({name, false, "new: not in the baseline"});
        } else if (pair.second == nullptr) {
            found.push_back({name, true, "gone: no such function any more"});
        } else if (const auto change = change_of(*pair.first, *pair.second)) {
            found.push_back(*change);
        }
    }
    return found;
}

}  // namespace qemu
