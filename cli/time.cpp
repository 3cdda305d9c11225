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

namespace cli {
namespace {

constexpr std::size_t hot_rows = 20;

struct Options {
    TimedElf timed;
    std::vector<std::string> functions;
    Output json;
    std::filesystem::path calls;
};

void run(const Options& options) {
    const qemu::Elf elf(options.timed.elf);
    const timing::TimingRequest request = to_request(options.timed, elf);
    const timing::CoreFile core = timing::cores_of(request).front();
    qemu::check_runs_on_board(elf, base::machine_of_core(timing::name_of(core.core)));
    std::vector<qemu::Function> functions;
    for (const std::string& name : options.functions) {
        functions.push_back(elf.function(name));
    }
    options.json.check();
    if (!options.calls.empty()) {
        base::check_writable(options.calls);
    }
    const std::vector<timing::TimingLog> logs = time_functions(options.timed, functions, request, false);

    std::vector<qemu::FunctionReport> reports;
    std::ostringstream calls;
    qemu::write_calls_header(calls);
    for (std::size_t f = 0; f < functions.size(); ++f) {
        const qemu::Function& function = functions[f];
        const timing::TimingLog& log = logs.at(f);
        reports.push_back({function.name, core, options.timed.without, qemu::function_time(log), {}});
        reports.back().hot = qemu::hot_instructions(reports.back().time, elf, hot_rows);
        fmt::print("{}{}", reports.size() > 1 ? "\n" : "", qemu::to_text(reports.back()));
        qemu::write_calls(calls, function.name, log);
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
    command
        .add_option("--function", options->functions,
                    "Symbol, or C++ name with or without parameters; several, each with its own calls, in one run")
        .required();
    add_timing_options(command, options->timed);
    command.add_option("--without", options->timed.without, "Effects that cost nothing: single_issue, load_use, ...")
        .delimiter(',');
    options->json.add_to(command, "--json", "The result; of several functions a list");
    command.add_option("--calls", options->calls, "Writes a CSV there, a row a call");
    command.callback([options] { run(*options); });
}

}  // namespace cli
