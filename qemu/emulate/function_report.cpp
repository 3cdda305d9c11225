#include "qemu/emulate/function_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "qemu/emulate/disassemble.hpp"

namespace qemu {
std::vector<HotInstruction> hot_instructions(const FunctionTime& time, const Elf& elf, std::size_t most) {
    std::vector<HotInstruction> hot;
    for (const auto& [address, spot] : time.hot) {
        if (hot.size() == most) {
            break;
        }
        const Function* const holder = elf.function_at(address);
        hot.push_back({address, holder != nullptr ? holder->name : "", disassemble(elf.path(), address),
                       in_cycles(spot.half_cycles),
                       spot.lost > 0 ? std::string(timing::effect_names[timing::index(spot.reason)]) : "",
                       in_cycles(spot.lost)});
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
    text += fmt::format("{:<16} {:>12.1f} {:>12.1f} {:>12.1f}   band {:.1f} to {:.1f}\n", "model cycles",
                        in_cycles(time.nominal.min), in_cycles(time.nominal.median), in_cycles(time.nominal.max),
                        in_cycles(time.low), in_cycles(time.high));
    text += fmt::format("{:<16} {:>12}\n\n", "stack bytes", time.stack_bytes);
    text += fmt::format("{:<28} {:>12}   (median of the calls)\n", "lost to", "cycles");
    for (std::size_t e = 0; e < time.lost.size(); ++e) {
        if (time.lost[e].max > 0) {
            text += fmt::format("{:<28} {:>12.1f}\n", timing::effect_names[e], in_cycles(time.lost[e].median));
        }
    }
    if (time.in_double.max > 0) {
        text += fmt::format("{:<28} {:>12.1f}   (all cycles within its routines)\n", timing::double_in_software,
                            in_cycles(time.in_double.median));
    }
    for (const std::string& effect : report.without) {
        if (std::find(timing::effects_beside_a_call.begin(), timing::effects_beside_a_call.end(), effect) !=
            timing::effects_beside_a_call.end()) {
            text += fmt::format("{:<28} {:>12.1f}   (lies beside a call, which is what is timed here)\n", effect, 0.0);
        }
    }
    text += fmt::format("\n{:<12} {:>12}  {:<18} {:<24} {}\n", "address", "cycles", "most lost to", "symbol",
                        "instruction, all calls together");
    for (const HotInstruction& hot : report.hot) {
        text += fmt::format("{:<12} {:>12.1f}  {:<18} {:<24} {}\n", fmt::format("{:#010x}", hot.address), hot.cycles,
                            hot.reason, hot.symbol.substr(0, 24), hot.disassembly);
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

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const FunctionReport& report, const std::string& elf_sha256) {
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
    json["model_cycles"] = {{"min", in_cycles(time.nominal.min)},
                            {"median", in_cycles(time.nominal.median)},
                            {"max", in_cycles(time.nominal.max)},
                            {"low", in_cycles(time.low)},
                            {"high", in_cycles(time.high)}};
    for (std::size_t s = 0; s < time.sets.size(); ++s) {
        json["rule_sets"].push_back({{"name", report.core.sets.at(s).name},
                                     {"fits", report.core.sets[s].fits},
                                     {"min", in_cycles(time.sets[s].min)},
                                     {"median", in_cycles(time.sets[s].median)},
                                     {"max", in_cycles(time.sets[s].max)}});
    }
    json["stack_bytes"] = time.stack_bytes;
    json["stalls"] = Json::object();
    for (std::size_t e = 0; e < time.lost.size(); ++e) {
        json["stalls"][std::string(timing::effect_names[e])] = in_cycles(time.lost[e].median);
    }
    json["stalls"][std::string(timing::double_in_software)] = in_cycles(time.in_double.median);
    json["hot"] = Json::array();
    for (const HotInstruction& hot : report.hot) {
        json["hot"].push_back({{"address", fmt::format("{:#010x}", hot.address)},
                               {"symbol", hot.symbol},
                               {"disassembly", hot.disassembly},
                               {"cycles", hot.cycles},
                               {"reason", hot.reason},
                               {"lost", hot.lost}});
    }
    json["unknown_encodings"] = Json::array();
    for (const auto& [address, times] : time.unknown) {
        json["unknown_encodings"].push_back({{"address", fmt::format("{:#010x}", address)}, {"executions", times}});
    }
    return json;
}

}  // namespace

std::string to_json(const FunctionReport& report, const std::string& elf_sha256) {
    return json_of(report, elf_sha256).dump(1) + "\n";
}

std::string to_json(const std::vector<FunctionReport>& reports, const std::string& elf_sha256) {
    if (reports.size() == 1) {
        return to_json(reports.front(), elf_sha256);
    }
    Json list = Json::array();
    for (const FunctionReport& report : reports) {
        list.push_back(json_of(report, elf_sha256));
    }
    return list.dump(1) + "\n";
}

void write_calls_header(std::ostream& out) {
    out << "function,call,instructions,model_cycles,low,high";
    for (const std::string_view effect : timing::effect_names) {
        out << ',' << effect;
    }
    out << ',' << timing::double_in_software << '\n';
}

void write_calls(std::ostream& out, const std::string& function, const timing::TimingLog& log, std::size_t core) {
    std::uint64_t call = 0;
    for (const timing::TimedRun& run : log.runs) {
        const timing::CoreTime& time = run.call.cores.at(core);
        std::string rest = fmt::format(",{}", run.call.instructions);
        for (const std::int64_t half : time.half_cycles) {
            rest += fmt::format(",{}", in_cycles(half));
        }
        for (const std::int64_t half : time.losses) {
            rest += fmt::format(",{}", in_cycles(half));
        }
        rest += fmt::format(",{}\n", in_cycles(time.double_in_software));
        for (std::uint64_t i = 0; i < run.calls; ++i) {
            out << '"' << function << "\"," << ++call << rest;
        }
    }
}

}  // namespace qemu
