// glsum indices: how far models are from a log.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "cli/output.hpp"
#include "drive/indices.hpp"
#include "drive/over_log.hpp"
#include "drive/response.hpp"

namespace cli {
namespace {

struct Options {
    std::filesystem::path log;
    drive::Columns columns;
    std::vector<std::filesystem::path> models;
    std::filesystem::path simulated;
    Output json;
    std::filesystem::path out;
};

void run(const Options& options) {
    if (options.models.empty() && options.simulated.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input, "indices: expected --model or --simulated, found neither");
    }
    drive::Columns columns = options.columns;
    columns.needs_input = !options.models.empty();
    const drive::Log log = read_ordered_log(options.log, columns);
    const drive::Log from_start = drive::from_start(log);
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    std::string table = fmt::format("{:<28} {:>11} {:>11} {:>11} {:>11} {:>11} {:>10} {:>14}\n", "", "ISE", "IAE",
                                    "ITSE", "ITAE", "MaxAPE", "NRMSE fit", "NRMSE printed");
    std::size_t skipped = 0;
    const auto add = [&](const std::string& name, const std::vector<double>& modelled) {
        const drive::Indices found = drive::compute_indices(log.time_s, log.output, modelled);
        skipped = found.max_ape_skipped;
        table += fmt::format("{:<28} {:>11.4e} {:>11.4e} {:>11.4e} {:>11.4e} {:>11.4e} {:>9.2f}% {:>13.4f}%\n", name,
                             found.ise, found.iae, found.itse, found.itae, found.max_ape, 100 * found.nrmse_fit,
                             100 * found.nrmse_printed);
        all.push_back({{"model", name},
                       {"ise", found.ise},
                       {"iae", found.iae},
                       {"itse", found.itse},
                       {"itae", found.itae},
                       {"max_ape", found.max_ape},
                       {"max_ape_skipped", found.max_ape_skipped},
                       {"nrmse_fit", found.nrmse_fit},
                       {"nrmse_printed", found.nrmse_printed},
                       {"rmse", found.rmse},
                       {"max_error", found.max_error}});
    };
    for (const auto& path : options.models) {
        const drive::Model model = read_model(path);
        const gap::Improved improved = simulate_effects(model, from_start, path.string());
        add(path.string(),
            improved.output.empty()
                ? drive::respond(model, drive::changes_of(from_start.time_s, log.input), from_start.time_s)
                : improved.output);
    }
    if (!options.simulated.empty()) {
        drive::Columns simulated_columns;
        simulated_columns.needs_input = false;
        const drive::Log simulated = read_ordered_log(options.simulated, simulated_columns);
        if (simulated.time_s != log.time_s) {
            throw glsum::Failure(glsum::Exit::not_comparable,
                                 fmt::format("{}: expected the {} stamps of {}; resample one of them first",
                                             options.simulated.string(), log.time_s.size(), log.name));
        }
        add(options.simulated.string(), simulated.output);
    }
    table +=
        "NRMSE fit is 1 - ||e|| / ||y - mean y||, MATLAB's; NRMSE printed is the paper's formula, 1 - ||e|| / (T (max "
        "y - "
        "min y)).\n";
    if (skipped > 0) {
        table += fmt::format("MaxAPE leaves out {} samples measured as exactly 0.\n", skipped);
    }
    put_either(
        options.json, [&] { return all.dump(2) + "\n"; }, [&] { return table; }, options.out);
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "A model is simulated exactly, at the log's own stamps, from rest; one that diagnose improved, with its "
        "effects.\n"
        "Example: glsum indices log.csv --model drive/models/niopdt.json --model drive/models/sopdt.json");
    command.add_option("log,--log", options->log, "Measured log, CSV").required();
    command.add_option("--model", options->models, "Model JSON; repeatable");
    command.add_option("--simulated", options->simulated, "CSV with an output at the same stamps, instead of a model");
    add_column_options(command, options->columns);
    options->json.add_to(command, "--json", "All of it");
    command.add_option("--out", options->out, "File; printed if not given");
    command.callback([options] { run(*options); });
}

}  // namespace cli
