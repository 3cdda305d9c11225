#include "cli/generate_controller.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/generate/header.hpp"
#include "bench/steppers/controller/certificate.hpp"
#include "bench/steppers/controller/controller_header.hpp"
#include "bench/steppers/controller/report.hpp"
#include "bench/steppers/controller/written.hpp"
#include "bench/steppers/stepper/verify.hpp"
#include "bench/target/target_rows.hpp"
#include "bench/texts/text.hpp"
#include "cli/board.hpp"
#include "cli/header_options.hpp"
#include "drive/model_file.hpp"
#include "qemu/emulate/foreign_program.hpp"

namespace cli {
namespace {

generate::LoopReport report_of_loop(const generate::ControllerSpec& spec, const ControllerOptions& options) {
    const drive::Model plant =
        drive::parse_model(base::read_file(options.plant, drive::most_model_bytes), options.plant);
    const tune::Margins margins = generate::certify(spec, plant, options.controller, options.plant);
    return {options.plant, drive::to_text(plant), generate::measure_loop(spec, plant, spec.horizon), margins};
}

// Here, and on the target where it was built, beside the integer PID of the same gains.
void verify(generate::ControllerReport& report, const generate::ControllerSpec& spec,
            const generate::WrittenStepper& written, const std::string& licence) {
    report.checked = {generate::check_bits_here(written)};
    std::vector<generate::WrittenStepper> controllers = {written};
    const generate::ControllerSpec whole = generate::whole_orders(spec);
    const drive::Gains& gains = spec.controller.gains;
    if (gains.integral_order != 1.0 || (gains.kd != 0.0 && gains.derivative_order != 1.0)) {
        const std::string prefix = written.prefix + "_whole";
        controllers.push_back(
            generate::written(whole, prefix, generate::make_controller_header(whole, prefix, licence, {})));
    }
    const base::Machine& machine = qemu::machine_of({report.core, "", ""}, cores_folder());
    try {
        const auto all = generate::check_on_target(controllers, built_board(machine),
                                                   bench::timing_request(cores_folder(), {report.core}));
        report.checked.push_back(all[0].bits);
        report.cost = all[0].cost;
        if (all.size() > 1) {
            report.whole = all[1].cost;
        }
    } catch (const glsum::Failure& failure) {
        if (failure.status() != glsum::Exit::missing) {
            throw;
        }
        fmt::print("bits on the emulated {}: not compared: {}\n", machine.name, failure.what());
    }
    for (const generate::CheckedBits& one : report.checked) {
        fmt::print("{}\n", generate::to_text(one));
    }
    fmt::print("{}", generate::cost_table(report));
}

}  // namespace

void generate_controller(const ControllerOptions& options, const std::string& command) {
    if (options.out.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input, "--out: expected a file to write");
    }
    base::check_writable(options.out);
    options.json.check();
    generate::ControllerSpec spec;
    spec.controller =
        drive::parse_fopid(base::read_file(options.controller, drive::most_model_bytes), options.controller);
    if (options.max_error != 0.0) {
        if (!(options.max_error > 0.0 && std::isfinite(options.max_error))) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("--max-error: expected a number above 0, found {}", options.max_error));
        }
        spec.max_error = options.max_error;
    }
    spec.horizon = options.samples != 0 ? options.samples : spec.horizon;
    spec.input_full_scale = input_full_scale(options.format, options.input_scale, "set point and measured value");
    const std::string prefix = options.prefix.empty() ? generate::prefix_of_file(options.out) : options.prefix;
    generate::ControllerReport report{options.controller, options.out};
    std::vector<std::string> lines = {""};
    if (!options.plant.empty()) {
        report.loop = report_of_loop(spec, options);
        for (const std::string& line : generate::to_lines(*report.loop, spec)) {
            fmt::print("{}\n", line);
            lines.push_back(line);
        }
        lines.emplace_back();
    }
    lines.push_back("Command: " + command);
    const std::string header = generate::make_controller_header(spec, prefix, options.licence, lines);
    base::write_file(options.out, header);
    const drive::Gains& gains = spec.controller.gains;
    fmt::print("{} in {}: sums of {}{} coefficients\n", options.controller, options.out,
               generate::integral_sum(spec).taps,
               gains.kd != 0.0 ? fmt::format(" and {}", generate::derivative_sum(spec).taps) : "");
    if (options.verify) {
        report.core = options.core;
        verify(report, spec, generate::written(spec, prefix, header), options.licence);
    }
    if (options.json.wanted()) {
        options.json.write(generate::to_json(report, spec));
    }
    for (const generate::CheckedBits& checked : report.checked) {
        if (!checked.good()) {
            throw glsum::Failure(glsum::Exit::check_failed,
                                 fmt::format("{}: expected the bits of the library's {} stepper, found others {}",
                                             options.out, spec.input_full_scale ? "q31" : "float", checked.where));
        }
    }
}

}  // namespace cli
