#include "cli/timed_elf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "base/failure.hpp"
#include "cli/name_value.hpp"
#include "qemu/emulate/foreign_program.hpp"
#include "qemu/emulate/timed_program.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

std::optional<std::uint32_t> to_address(const std::string& text) {
    std::uint32_t value = 0;
    const char* const begin = text.data() + (text.starts_with("0x") ? 2 : 0);
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value, 16);
    return error == std::errc{} && end == text.data() + text.size() && end != begin ? std::optional(value)
                                                                                    : std::nullopt;
}

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

}  // namespace

timing::TimingRequest to_request(const TimedElf& options, const qemu::Elf& elf) {
    timing::TimingRequest request;
    request.cores_folder = cores_folder().string();
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

void add_timing_options(Command& command, TimedElf& options) {
    command.add_option("--core", options.core, "Core file: a name of qemu/cores, or a path").capture_default_str();
    command.add_option("--place", options.places,
                       "code=itcm/flash/axi, data=dtcm/axi, or itcm/dtcm/flash/axi of a section (.rodata=dtcm) or of\n"
                       "addresses (0x20001000-0x20002000=axi); beats the core file");
    command.add_option("--timeout", options.timeout, "Seconds that the program may stay silent")
        .at_least(1)
        .capture_default_str();
}

std::vector<timing::TimingLog> time_functions(const TimedElf& options, const std::vector<qemu::Function>& functions,
                                              const timing::TimingRequest& request, bool uncalled) {
    std::vector<std::uint32_t> entries;
    for (const qemu::Function& function : functions) {
        entries.push_back(function.address);
    }
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    const base::Machine& machine = qemu::machine_of(request.cores.front(), request.cores_folder);
    const qemu::Emulator emulator{emulate_script(machine), std::chrono::seconds(options.timeout),
                                  std::chrono::seconds(10)};
    const std::vector<timing::TimingLog> sorted =
        qemu::time_program(emulator, plugin(), options.elf, {functions.empty() ? "marks" : functions.front().name},
                           entries, request, {}, {}, uncalled);
    std::vector<timing::TimingLog> logs;
    for (const qemu::Function& function : functions) {
        const auto at = std::lower_bound(entries.begin(), entries.end(), function.address) - entries.begin();
        logs.push_back(sorted.at(static_cast<std::size_t>(at)));
    }
    logs.insert(logs.end(), sorted.begin() + static_cast<std::ptrdiff_t>(entries.size()), sorted.end());
    return logs;
}

}  // namespace cli
