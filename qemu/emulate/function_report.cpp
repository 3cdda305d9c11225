#include "qemu/emulate/function_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "qemu/emulate/disassemble.hpp"

namespace qemu {
namespace {

double cycles(std::int64_t half) { return static_cast<double>(half) / 2.0; }

}  // namespace

std::vector<HotInstruction> hot_instructions(const FunctionTime& time, const Elf& elf, std::size_t most) {
    std::vector<HotInstruction> hot;
    for (const auto& [address, half] : time.hot) {
        if (hot.size() == most) {
            break;
        }
        const Function* const holder = elf.function_at(address);
        hot.push_back({address, holder != nullptr ? holder->name : "", disassemble(elf.path(), address), cycles(half)});
    }
    return hot;
}

std::string to_text(const FunctionReport& report) {
    const FunctionTime& time = report.time;
    std::string text = fmt::format("{} on {}, code in {}, data in {}: {} calls\n\n", report.function, report.core.name,
                                   timing::name_of(report.core.placement.code),
                                   timing::name_of(report.core.placement.data), time.calls);
    text += fmt::format("{:<16} {:>12} {:>12} {:>12}\n", "", "min", "median", "max");
    text += fmt::format("{:<16} {:>12} {:>12} {:>12}\n", "instructions", time.instructions.min,
                        time.instructions.median, time.instructions.max);
    text += fmt::format("{:<16} {:>12.1f} {:>12.1f} {:>12.1f}   band {:.1f} to {:.1f}\n\n", "model cycles",
                        cycles(time.nominal.min), cycles(time.nominal.median), cycles(time.nominal.max),
                        cycles(time.low), cycles(time.high));
    text += fmt::format("{:<28} {:>12}   (median of the calls)\n", "lost to", "cycles");
    for (std::size_t e = 0; e < time.lost.size(); ++e) {
        if (time.lost[e].max > 0) {
            text += fmt::format("{:<28} {:>12.1f}\n", timing::effect_names[e], cycles(time.lost[e].median));
        }
    }
    if (time.in_double.max > 0) {
        text += fmt::format("{:<28} {:>12.1f}   (all cycles within its routines)\n", timing::double_in_software,
                            cycles(time.in_double.median));
    }
    for (const std::string& effect : report.without) {
        if (std::find(timing::effects_beside_a_call.begin(), timing::effects_beside_a_call.end(), effect) !=
            timing::effects_beside_a_call.end()) {
            text += fmt::format("{:<28} {:>12.1f}   (lies beside a call, which is what is timed here)\n", effect, 0.0);
        }
    }
    text +=
        fmt::format("\n{:<12} {:>12}  {:<24} {}\n", "address", "cycles", "symbol", "instruction, all calls together");
    for (const HotInstruction& hot : report.hot) {
        text += fmt::format("{:<12} {:>12.1f}  {:<24} {}\n", fmt::format("{:#010x}", hot.address), hot.cycles,
                            hot.symbol.substr(0, 24), hot.disassembly);
    }
    for (const auto& [address, times] : time.unknown) {
        text += fmt::format("unknown encoding at {:#010x}, executed {} times: modelled as one that issues alone\n",
                            address, times);
    }
    if (time.recursive) {
        text += fmt::format("{} calls itself: the inner calls count as part of the outer\n", report.function);
    }
    return text;
}

std::string to_json(const FunctionReport& report, const std::string& elf_sha256) {
    using Json = nlohmann::ordered_json;
    const FunctionTime& time = report.time;
    Json json;
    json["schema"] = "glsum-time-1";
    json["elf_sha256"] = elf_sha256;
    json["function"] = report.function;
    json["core"] = report.core.name;
    json["placement"] = {{"code", timing::name_of(report.core.placement.code)},
                         {"data", timing::name_of(report.core.placement.data)}};
    for (const timing::PlacedRange& range : report.core.placement.ranges) {
        json["placement"]["ranges"].push_back({{"begin", fmt::format("{:#010x}", range.begin)},
                                               {"end", fmt::format("{:#010x}", range.end)},
                                               {"place", timing::name_of(range.place)}});
    }
    json["calls"] = time.calls;
    json["instructions"] = {
        {"min", time.instructions.min}, {"median", time.instructions.median}, {"max", time.instructions.max}};
    json["model_cycles"] = {{"min", cycles(time.nominal.min)},
                            {"median", cycles(time.nominal.median)},
                            {"max", cycles(time.nominal.max)},
                            {"low", cycles(time.low)},
                            {"high", cycles(time.high)}};
    json["stalls"] = Json::object();
    for (std::size_t e = 0; e < time.lost.size(); ++e) {
        json["stalls"][std::string(timing::effect_names[e])] = cycles(time.lost[e].median);
    }
    json["stalls"][std::string(timing::double_in_software)] = cycles(time.in_double.median);
    json["hot"] = Json::array();
    for (const HotInstruction& hot : report.hot) {
        json["hot"].push_back({{"address", fmt::format("{:#010x}", hot.address)},
                               {"symbol", hot.symbol},
                               {"disassembly", hot.disassembly},
                               {"cycles", hot.cycles}});
    }
    json["unknown_encodings"] = Json::array();
    for (const auto& [address, times] : time.unknown) {
        json["unknown_encodings"].push_back({{"address", fmt::format("{:#010x}", address)}, {"executions", times}});
    }
    return json.dump(1) + "\n";
}

}  // namespace qemu
