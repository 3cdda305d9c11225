// glsum time: what a function of anybody's firmware takes on a modelled Cortex-M7.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/sha256.hpp"
#include "bench/rows/row.hpp"
#include "cli/board.hpp"
#include "cli/command.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/timed_program.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;
using Json = nlohmann::ordered_json;

constexpr std::size_t hot_rows = 20;

struct Options {
    std::filesystem::path elf;
    std::string function;
    std::string core = default_core;
    std::vector<std::string> places;
    std::vector<std::string> without;
    std::filesystem::path json;
    unsigned timeout = 120;
};

std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string text;
    char buffer[4096];
    for (std::size_t got; pipe && (got = fread(buffer, 1, sizeof buffer, pipe.get())) > 0;) {
        text.append(buffer, got);
    }
    return text;
}

// The text of one instruction, as objdump has it; empty without objdump.
std::string disassemble(const std::filesystem::path& elf, std::uint32_t address) {
    const std::string text = output_of(fmt::format(
        "arm-none-eabi-objdump -d --no-show-raw-insn --start-address={:#x} --stop-address={:#x} '{}' 2>/dev/null",
        address, address + 4, elf.string()));
    // "  1a4:\tadds\tr0, #1": as wide as the section's addresses need.
    const std::string mark = fmt::format("{:x}:\t", address);
    const std::size_t at = text.find(mark);
    if (at == 0 || at == std::string::npos || (text[at - 1] != ' ' && text[at - 1] != '\n')) {
        return "";
    }
    std::string line = text.substr(at + mark.size(), text.find('\n', at + mark.size()) - at - mark.size());
    std::replace(line.begin(), line.end(), '\t', ' ');
    return line;
}

// How often a quantity had each value.
class Distribution {
public:
    void add(std::int64_t value, std::uint64_t times) {
        counts_[value] += times;
        total_ += times;
    }
    [[nodiscard]] std::int64_t min() const { return counts_.begin()->first; }
    [[nodiscard]] std::int64_t max() const { return counts_.rbegin()->first; }
    /// The lower one of two in the middle.
    [[nodiscard]] std::int64_t median() const {
        std::uint64_t seen = 0;
        for (const auto& [value, times] : counts_) {
            seen += times;
            if (2 * seen >= total_) {
                return value;
            }
        }
        return 0;
    }

private:
    std::map<std::int64_t, std::uint64_t> counts_;
    std::uint64_t total_ = 0;
};

timing::TimingRequest to_request(const Options& options, const std::filesystem::path& cores_folder) {
    timing::TimingRequest request;
    request.cores_folder = cores_folder.string();
    timing::TimingRequest::Core core{options.core, "", ""};
    core.without = options.without;
    for (const std::string& place : options.places) {
        const std::string key = place.substr(0, place.find('='));
        const std::string value = place.find('=') == std::string::npos ? "" : place.substr(place.find('=') + 1);
        if (key == "code") {
            core.code = timing::name_of(timing::code_place_named(value));
        } else if (key == "data") {
            core.data = timing::name_of(timing::data_place_named(value));
        } else {
            throw Failure(Exit::bad_input, fmt::format("--place: expected code=... or data=..., found {}", place));
        }
    }
    request.cores.push_back(core);
    return request;
}

void run(const Options& options) {
    const std::filesystem::path source = build_info::source_folder;
    const std::filesystem::path built = build_info::build_folder;
    const timing::TimingRequest request = to_request(options, cores_folder());
    const timing::CoreFile core = timing::cores_of(request).front();
    const qemu::Elf elf(options.elf);
    elf.check_runs_on_cortex_m7();
    const qemu::Function function = elf.function(options.function);
    if (!options.json.empty()) {
        base::check_writable(options.json);
    }
    const qemu::Emulator emulator{source / "targets" / "mps2-an500" / "emulate", std::chrono::seconds(options.timeout),
                                  std::chrono::seconds(10)};
    const timing::TimingLog log = qemu::time_program(emulator, built / "qemu" / "glsum_plugin.so", options.elf,
                                                     {function.name}, {function.address}, request, {}, {})
                                      .front();

    Distribution instructions;
    std::vector<Distribution> half_cycles;  // the nominal set, then what spans the band
    std::vector<Distribution> losses(timing::effect_count);
    Distribution in_double;
    std::uint64_t calls = 0;
    for (const timing::TimedRun& run : log.runs) {
        calls += run.calls;
        instructions.add(static_cast<std::int64_t>(run.call.instructions), run.calls);
        const timing::CoreTime& time = run.call.cores.at(0);
        half_cycles.resize(time.half_cycles.size());
        for (std::size_t s = 0; s < half_cycles.size(); ++s) {
            half_cycles[s].add(time.half_cycles[s], run.calls);
        }
        for (std::size_t e = 0; e < losses.size(); ++e) {
            losses[e].add(time.losses[e], run.calls);
        }
        in_double.add(time.double_in_software, run.calls);
    }
    const auto cycles = [](std::int64_t half) { return static_cast<double>(half) / 2.0; };
    double low = cycles(half_cycles[0].median());
    double high = low;
    for (const Distribution& set : half_cycles) {
        low = std::min(low, cycles(set.median()));
        high = std::max(high, cycles(set.median()));
    }

    Json json;
    json["schema"] = "glsum-time-1";
    json["elf_sha256"] = base::sha256_of(options.elf);
    json["function"] = function.name;
    json["core"] = core.name;
    json["placement"] = {{"code", timing::name_of(core.placement.code)},
                         {"data", timing::name_of(core.placement.data)}};
    json["calls"] = calls;
    json["instructions"] = {
        {"min", instructions.min()}, {"median", instructions.median()}, {"max", instructions.max()}};
    json["model_cycles"] = {{"min", cycles(half_cycles[0].min())},
                            {"median", cycles(half_cycles[0].median())},
                            {"max", cycles(half_cycles[0].max())},
                            {"low", low},
                            {"high", high}};
    json["stalls"] = Json::object();
    for (std::size_t e = 0; e < losses.size(); ++e) {
        json["stalls"][std::string(timing::effect_names[e])] = cycles(losses[e].median());
    }
    json["stalls"][std::string(timing::double_in_software)] = cycles(in_double.median());
    std::vector<std::pair<std::int64_t, std::uint32_t>> hot;
    for (const auto& [address, half] : log.hot.empty() ? std::map<std::uint32_t, std::int64_t>{} : log.hot[0]) {
        hot.emplace_back(half, address);
    }
    std::sort(hot.begin(), hot.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    json["hot"] = Json::array();
    for (std::size_t i = 0; i < std::min(hot_rows, hot.size()); ++i) {
        const qemu::Function* holder = elf.function_at(hot[i].second);
        json["hot"].push_back({{"address", fmt::format("{:#010x}", hot[i].second)},
                               {"symbol", holder != nullptr ? holder->name : ""},
                               {"disassembly", disassemble(options.elf, hot[i].second)},
                               {"cycles", cycles(hot[i].first)}});
    }
    json["unknown_encodings"] = Json::array();
    for (const auto& [address, times] : log.unknown) {
        json["unknown_encodings"].push_back({{"address", fmt::format("{:#010x}", address)}, {"executions", times}});
    }

    fmt::print("{} on {}, code in {}, data in {}: {} calls\n\n", function.name, core.name,
               timing::name_of(core.placement.code), timing::name_of(core.placement.data), calls);
    fmt::print("{:<16} {:>12} {:>12} {:>12}\n", "", "min", "median", "max");
    fmt::print("{:<16} {:>12} {:>12} {:>12}\n", "instructions", instructions.min(), instructions.median(),
               instructions.max());
    fmt::print("{:<16} {:>12.1f} {:>12.1f} {:>12.1f}   band {:.1f} to {:.1f}\n\n", "model cycles",
               cycles(half_cycles[0].min()), cycles(half_cycles[0].median()), cycles(half_cycles[0].max()), low, high);
    fmt::print("{:<28} {:>12}   (median of the calls)\n", "lost to", "cycles");
    for (std::size_t e = 0; e < losses.size(); ++e) {
        if (losses[e].max() > 0) {
            fmt::print("{:<28} {:>12.1f}\n", timing::effect_names[e], cycles(losses[e].median()));
        }
    }
    if (in_double.max() > 0) {
        fmt::print("{:<28} {:>12.1f}   (all cycles within its routines)\n", timing::double_in_software,
                   cycles(in_double.median()));
    }
    for (const std::string& effect : options.without) {
        if (std::find(timing::effects_beside_a_call.begin(), timing::effects_beside_a_call.end(), effect) !=
            timing::effects_beside_a_call.end()) {
            fmt::print("{:<28} {:>12.1f}   (lies beside a call, which is what is timed here)\n", effect, 0.0);
        }
    }
    fmt::print("\n{:<12} {:>12}  {:<24} {}\n", "address", "cycles", "symbol", "instruction, all calls together");
    for (const Json& row : json["hot"]) {
        fmt::print("{:<12} {:>12.1f}  {:<24} {}\n", row["address"].get<std::string>(), row["cycles"].get<double>(),
                   row["symbol"].get<std::string>().substr(0, 24), row["disassembly"].get<std::string>());
    }
    for (const auto& [address, times] : log.unknown) {
        fmt::print("unknown encoding at {:#010x}, executed {} times: modelled as one that issues alone\n", address,
                   times);
    }
    if (log.recursive) {
        fmt::print("{} calls itself: the inner calls count as part of the outer\n", function.name);
    }
    if (!options.json.empty()) {
        base::write_file(options.json, json.dump(1) + "\n");
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "The program: bare metal, linked for the map of mps2-an500 (code from 0, data from 0x20000000), ending by a\n"
        "semihosting exit with status 0.\n"
        "Example: glsum time --elf my.elf --function filter_step --core stm32f746-flash --json time.json");
    command.add_option("--elf", options->elf, "The program").required();
    command.add_option("--function", options->function, "Symbol, or C++ name with or without parameters").required();
    command.add_option("--core", options->core, "Core file of qemu/cores").capture_default_str();
    command.add_option("--place", options->places, "code=itcm/flash/axi or data=dtcm/axi; beats the core file");
    command.add_option("--without", options->without, "Effects that cost nothing: single_issue, load_use, ...")
        .delimiter(',');
    command.add_option("--json", options->json, "Writes the result there");
    command.add_option("--timeout", options->timeout, "Seconds that the program may stay silent")
        .at_least(1)
        .capture_default_str();
    command.callback([options] { run(*options); });
}

}  // namespace cli
