#include "cli/generate_model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/generate/header.hpp"
#include "bench/steppers/model/model_header.hpp"
#include "bench/steppers/model/report.hpp"
#include "bench/target/target_rows.hpp"
#include "bench/texts/text.hpp"
#include "cli/board.hpp"
#include "cli/header_options.hpp"
#include "drive/model_file.hpp"
#include "qemu/emulate/foreign_program.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

double step_of(const ModelOptions& options, const drive::Model& model) {
    if (options.step_s != 0.0) {
        return options.step_s;
    }
    if (!model.sample_time_s) {
        throw Failure(Exit::bad_input,
                      fmt::format("{}: no sample_time_s; expected one there, or --step-s", options.model));
    }
    return *model.sample_time_s;
}

// Here, and on the target where it was built.
void verify(generate::ModelReport& report, const generate::WrittenStepper& written) {
    report.checked = {generate::check_bits_here(written)};
    const base::Machine& machine = qemu::machine_of({report.core, "", ""}, cores_folder());
    try {
        const auto all = generate::check_on_target({written}, built_board(machine),
                                                   bench::timing_request(cores_folder(), {report.core}));
        report.checked.push_back(all[0].bits);
        report.cost = all[0].cost;
    } catch (const Failure& failure) {
        if (failure.status() != Exit::missing) {
            throw;
        }
        fmt::print("bits on the emulated {}: not compared: {}\n", machine.name, failure.what());
    }
    for (const generate::CheckedBits& one : report.checked) {
        fmt::print("{}\n", generate::to_text(one));
    }
    if (report.cost) {
        fmt::print("{}", generate::cost_table({{report.model, *report.cost}}, report.core));
    }
}

}  // namespace

void generate_model(const ModelOptions& options, const std::string& command) {
    if (options.out.empty()) {
        throw Failure(Exit::bad_input, "--out: expected a file to write");
    }
    base::check_writable(options.out);
    options.json.check();
    const double max_error = options.max_error != 0.0 ? options.max_error : 1e-3;
    if (!(max_error > 0.0 && std::isfinite(max_error))) {
        throw Failure(Exit::bad_input, fmt::format("--max-error: expected a number above 0, found {}", max_error));
    }
    const std::optional<double> scale = input_full_scale(options.format, options.input_scale, "the input");
    const drive::Model model =
        drive::parse_model(base::read_file(options.model, drive::most_model_bytes), options.model);
    const std::string prefix = options.prefix.empty() ? generate::prefix_of_file(options.out) : options.prefix;
    const std::size_t samples = options.samples != 0 ? options.samples : generate::ModelSpec{}.samples;
    generate::ModelReport report{options.model, options.out,
                                 generate::choose_model(model, step_of(options, model), max_error, samples, scale),
                                 max_error};
    std::vector<std::string> lines = {""};
    for (const std::string& line : generate::to_lines(report.choice)) {
        fmt::print("{}\n", line);
        lines.push_back(line);
    }
    lines.insert(lines.end(), {"", "Command: " + command});
    const std::string header = generate::make_model_header(report.choice.spec, prefix, options.licence, lines);
    base::write_file(options.out, header);
    fmt::print("{} in {}\n", options.model, options.out);
    if (options.verify) {
        report.core = options.core;
        verify(report, generate::written(report.choice.spec, prefix, header));
    }
    if (options.json.wanted()) {
        options.json.write(generate::to_json(report));
    }
    for (const generate::CheckedBits& checked : report.checked) {
        if (!checked.good()) {
            throw Failure(Exit::check_failed,
                          fmt::format("{}: expected the bits of the library's stepper, found others {}", options.out,
                                      checked.where));
        }
    }
}

}  // namespace cli
