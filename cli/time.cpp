// glsum time: what a function of anybody's firmware takes on a modelled core.
#include <fmt/format.h>

#include <memory>
#include <sstream>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/sha256.hpp"
#include "cli/command.hpp"
#include "cli/output.hpp"
#include "cli/timed_elf.hpp"
#include "qemu/emulate/foreign_program.hpp"
#include "qemu/emulate/function_report.hpp"
#include "qemu/stream/stretch_marks.hpp"

namespace cli {
namespace {

constexpr std::size_t hot_rows = 20;

struct Options {
    TimedElf timed;
    std::vector<std::string> functions;
    bool marks = false;
    Output json;
    std::filesystem::path calls;
};

// A place in a program as debuggers write it: filter+0x1c.
std::string place_of(std::uint32_t address, const qemu::Elf& elf) {
    const qemu::Function* const function = elf.function_at(address);
    return function != nullptr ? fmt::format("{}+{:#x}", function->name, address - function->address)
                               : fmt::format("{:#010x}", address);
}

void run(const Options& options) {
    if (options.functions.empty() && !options.marks) {
        throw glsum::Failure(glsum::Exit::bad_input, "time: expected --function NAME or --marks");
    }
    const qemu::Elf elf(options.timed.elf);
    timing::TimingRequest request = to_request(options.timed, elf);
    const timing::CoreFile core = timing::cores_of(request).front();
    qemu::check_runs_on_board(elf, base::machine_of_core(timing::name_of(core.core)));
    std::vector<qemu::Function> functions;
    for (const std::string& name : options.functions) {
        functions.push_back(elf.function(name));
    }
    if (options.marks) {
        request.stretches = elf.halfwords_in_code(qemu::stretch_begins);
        if (request.stretches.empty()) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("{}: no glsum_mark_begin (mov r10, r10) in its code; "
                                             "targets/glsum_mark.h has it",
                                             elf.path().string()));
        }
    }
    options.json.check();
    if (!options.calls.empty()) {
        base::check_writable(options.calls);
    }
    const std::vector<timing::TimingLog> logs = time_functions(options.timed, functions, request, false);

    std::vector<qemu::FunctionReport> reports;
    std::ostringstream calls;
    qemu::write_calls_header(calls);
    std::vector<std::string> names;
    for (const qemu::Function& function : functions) {
        names.push_back(function.name);
    }
    for (const std::uint32_t begin : request.stretches) {
        names.push_back(place_of(begin, elf));
    }
    for (std::size_t part = 0; part < names.size(); ++part) {
        const timing::TimingLog& log = logs.at(part);
        if (log.runs.empty()) {
            continue;  // a stretch that was not met
        }
        reports.push_back({names[part], core, options.timed.without, qemu::function_time(log), {}});
        reports.back().hot = qemu::hot_instructions(reports.back().time, elf, hot_rows);
        fmt::print("{}{}", reports.size() > 1 ? "\n" : "", qemu::to_text(reports.back()));
        qemu::write_calls(calls, names[part], log);
    }
    if (options.json.wanted()) {
        options.json.write(qemu::to_json(reports, base::sha256_of(options.timed.elf)));
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
    command.add_option("--elf", options->timed.elf, "The program").required();
    command.add_option("--function", options->functions,
                       "Symbol, or C++ name with or without parameters; several, each with its own calls, in one run");
    command.add_flag("--marks", options->marks,
                     "Each stretch between the marks of targets/glsum_mark.h (mov r10, r10 and mov r11, r11), by\n"
                     "the place of its first");
    add_timing_options(command, options->timed);
    command.add_option("--without", options->timed.without, "Effects that cost nothing: single_issue, load_use, ...")
        .delimiter(',');
    options->json.add_to(command, "--json", "The result; of several functions a list");
    command.add_option("--calls", options->calls, "Writes a CSV there, a row a call");
    command.callback([options] { run(*options); });
}

}  // namespace cli
