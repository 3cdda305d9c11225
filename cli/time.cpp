// glsum time: what a function of anybody's firmware takes on a modelled Cortex-M7.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <sstream>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/sha256.hpp"
#include "cli/board.hpp"
#include "cli/command.hpp"
#include "cli/name_value.hpp"
#include "qemu/emulate/foreign_program.hpp"
#include "qemu/emulate/function_report.hpp"
#include "qemu/emulate/timed_program.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

constexpr std::size_t hot_rows = 20;

std::optional<std::uint32_t> to_address(const std::string& text) {
    std::uint32_t value = 0;
    const char* const begin = text.data() + (text.starts_with("0x") ? 2 : 0);
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value, 16);
    return error == std::errc{} && end == text.data() + text.size() && end != begin ? std::optional(value)
                                                                                    : std::nullopt;
}

struct Options {
    std::filesystem::path elf;
    std::vector<std::string> functions;
    std::string core = default_core;
    std::vector<std::string> places;
    std::vector<std::string> without;
    std::filesystem::path json;
    std::filesystem::path calls;
    unsigned timeout = 120;
};

// What lies elsewhere than its neighbours: .rodata=dtcm, or 0x20001000-0x20002000=axi.
timing::PlacedRange placed_range(const std::string& place, const qemu::Elf& elf) {
    const auto [key, value] = split_at_equals(place);
    timing::PlacedRange range;
    range.place = timing::place_named(value);
    if (key.starts_with('.')) {
        const auto [begin, end] = elf.section(key);
        range.begin = begin;
        range.end = end;
        return range;
    }
    const auto dash = key.find('-');
    const auto begin = dash == std::string::npos ? std::nullopt : to_address(key.substr(0, dash));
    const auto end = dash == std::string::npos ? std::nullopt : to_address(key.substr(dash + 1));
    if (!begin || !end || *begin >= *end) {
        throw Failure(Exit::bad_input,
                      fmt::format("--place: expected code=..., data=..., a section as .rodata=... or addresses as "
                                  "0x20001000-0x20002000=..., found {}",
                                  place));
    }
    range.begin = *begin;
    range.end = *end;
    return range;
}

timing::TimingRequest to_request(const Options& options, const qemu::Elf& elf,
                                 const std::filesystem::path& cores_folder) {
    timing::TimingRequest request;
    request.cores_folder = cores_folder.string();
    timing::TimingRequest::Core core = timing::core_asked_for(options.core);
    core.without = options.without;
    for (const std::string& place : options.places) {
        const auto [key, value] = split_at_equals(place);
        if (key == "code") {
            core.code = timing::name_of(timing::code_place_named(value));
        } else if (key == "data") {
            core.data = timing::name_of(timing::data_place_named(value));
        } else {
            core.ranges.push_back(placed_range(place, elf));
        }
    }
    request.cores.push_back(core);
    return request;
}

void run(const Options& options) {
    const qemu::Elf elf(options.elf);
    const timing::TimingRequest request = to_request(options, elf, cores_folder());
    const timing::CoreFile core = timing::cores_of(request).front();
    qemu::check_runs_on_board(elf);
    std::vector<qemu::Function> functions;
    std::vector<std::uint32_t> entries;
    for (const std::string& name : options.functions) {
        functions.push_back(elf.function(name));
        entries.push_back(functions.back().address);
    }
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    for (const std::filesystem::path& file : {options.json, options.calls}) {
        if (!file.empty()) {
            base::check_writable(file);
        }
    }
    const qemu::Emulator emulator{emulate_script(), std::chrono::seconds(options.timeout), std::chrono::seconds(10)};
    const std::vector<timing::TimingLog> logs =
        qemu::time_program(emulator, plugin(), options.elf, {functions.front().name}, entries, request, {}, {});

    std::vector<qemu::FunctionReport> reports;
    std::ostringstream calls;
    qemu::write_calls_header(calls);
    for (const qemu::Function& function : functions) {
        const auto at = std::lower_bound(entries.begin(), entries.end(), function.address) - entries.begin();
        const timing::TimingLog& log = logs.at(static_cast<std::size_t>(at));
        reports.push_back({function.name, core, options.without, qemu::function_time(log), {}});
        reports.back().hot = qemu::hot_instructions(reports.back().time, elf, hot_rows);
        fmt::print("{}{}", reports.size() > 1 ? "\n" : "", qemu::to_text(reports.back()));
        qemu::write_calls(calls, function.name, log);
    }
    if (!options.json.empty()) {
        base::write_file(options.json, qemu::to_json(reports, base::sha256_of(options.elf)));
    }
    if (!options.calls.empty()) {
        base::write_file(options.calls, calls.str());
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(fmt::format(
        "The program: bare metal, linked for the map of {} (code from 0, data from 0x20000000), ending by a\n"
        "semihosting exit with status 0.\n"
        "Example: glsum time --elf my.elf --function filter_step --core stm32f746-flash --json time.json",
        build_info::emulated_board));
    command.add_option("--elf", options->elf, "The program").required();
    command
        .add_option("--function", options->functions,
                    "Symbol, or C++ name with or without parameters; several, each with its own calls, in one run")
        .required();
    command.add_option("--core", options->core, "Core file: a name of qemu/cores, or a path").capture_default_str();
    command.add_option("--place", options->places,
                       "code=itcm/flash/axi, data=dtcm/axi, or itcm/dtcm/flash/axi of a section (.rodata=dtcm) or of\n"
                       "addresses (0x20001000-0x20002000=axi); beats the core file");
    command.add_option("--without", options->without, "Effects that cost nothing: single_issue, load_use, ...")
        .delimiter(',');
    command.add_option("--json", options->json, "Writes the result there; of several functions a list");
    command.add_option("--calls", options->calls, "Writes a CSV there, a row a call");
    command.add_option("--timeout", options->timeout, "Seconds that the program may stay silent")
        .at_least(1)
        .capture_default_str();
    command.callback([options] { run(*options); });
}

}  // namespace cli
