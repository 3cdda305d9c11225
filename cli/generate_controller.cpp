#include "cli/generate_controller.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/generate/controller/controller_header.hpp"
#include "bench/generate/controller/loop.hpp"
#include "bench/generate/header.hpp"
#include "drive/model_file.hpp"

namespace cli {

void generate_controller(const ControllerOptions& options, const std::string& command) {
    if (options.out.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input, "--out: expected a file to write");
    }
    base::check_writable(options.out);
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
    const std::string prefix = options.prefix.empty() ? generate::prefix_of_file(options.out) : options.prefix;
    const std::string licence = options.licence.empty() ? generate::Spec{}.licence : options.licence;
    std::vector<std::string> lines = {""};
    if (!options.plant.empty()) {
        const drive::Model plant =
            drive::parse_model(base::read_file(options.plant, drive::most_model_bytes), options.plant);
        const generate::LoopDeviation loop = generate::measure_loop(spec, plant, spec.horizon);
        lines.push_back(fmt::format("In a loop with {}, {} samples, the set point 1, then 0.4:", drive::to_text(plant),
                                    spec.horizon));
        lines.push_back(
            fmt::format("within {:.2g} of the same loop in double with full memory, as a part of the largest output;",
                        loop.header));
        lines.push_back(fmt::format("the sampling's own error, by halving the step: {:.2g}.", loop.sampling));
        for (std::size_t i = 1; i < lines.size(); ++i) {
            fmt::print("{}\n", lines[i]);
        }
        lines.emplace_back();
    }
    lines.push_back("Command: " + command);
    const std::string header = generate::make_controller_header(spec, prefix, licence, lines);
    base::write_file(options.out, header);
    const drive::Gains& gains = spec.controller.gains;
    fmt::print("{} in {}: sums of {}{} coefficients\n", options.controller, options.out,
               generate::integral_sum(spec).taps,
               gains.kd != 0.0 ? fmt::format(" and {}", generate::derivative_sum(spec).taps) : "");
}

}  // namespace cli
