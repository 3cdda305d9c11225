// glsum diagnose drive: where a drive and its simulation part, which effect explains it, how far the gap shrinks.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

#include "cli/commands.hpp"
#include "cli/drive_files.hpp"
#include "gap/drive/diagnose.hpp"
#include "gap/drive/start.hpp"
#include "gap/verdict.hpp"
#include "qemu/failure.hpp"

namespace cli {
namespace {

struct Options {
    std::string model;
    std::vector<std::filesystem::path> logs;
    std::vector<std::filesystem::path> validate;
    drive::Columns columns;
    std::optional<double> split_s;
    bool refit = false;
    std::vector<std::string> without;
    std::filesystem::path json;
    unsigned jobs = 1;
};

std::vector<gap::Record> read_records(const std::vector<std::filesystem::path>& paths, const drive::Columns& columns) {
    std::vector<gap::Record> records;
    for (const auto& path : paths) {
        records.push_back(gap::to_record(read_ordered_log(path, columns)));
    }
    return records;
}

void run(const Options& options) {
    std::vector<gap::Record> train = read_records(options.logs, options.columns);
    for (const std::string& name : options.without) {
        (void)gap::effect_named(name);
    }
    const bool fitted = options.model.starts_with("fit:");
    const drive::Form form =
        fitted ? gap::search_form(options.model.substr(4), train) : gap::form_of(read_model(options.model));
    const gap::Question question{form,
                                 fitted || options.refit,
                                 std::move(train),
                                 read_records(options.validate, options.columns),
                                 options.split_s,
                                 options.without,
                                 options.jobs};
    for (const gap::Record& record : question.validate) {
        if (record.time_s == question.train.front().time_s && record.output == question.train.front().output) {
            fmt::print(stderr, "glsum: warning: {}: is the training log itself: what fits it proves nothing\n",
                       record.name);
        }
    }
    const gap::Answer answer =
        gap::diagnose(question, [](const std::string& what) { fmt::print(stderr, "{}\n", what); });
    fmt::print("{}", gap::to_text(answer));
    if (!options.json.empty()) {
        put(gap::to_json(answer), options.json);
    }
}

}  // namespace

void add_diagnose(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("diagnose", "Where simulation and measurement part, and which effect explains it");
    command->require_subcommand(1);
    auto options = std::make_shared<Options>();
    options->jobs = std::max(1U, std::thread::hardware_concurrency());
    CLI::App* of_drive = command->add_subcommand("drive", "A model of a drive against its logs");
    of_drive->footer(
        "Without --refit the model is judged as it is, its parameters included. With it, or with fit:FORM, its gain, "
        "dynamics,\n"
        "dead time, offset and initial state are fitted first.\n"
        "Example: glsum diagnose drive --model model.json --log train.csv --validate other.csv --json verdict.json");
    of_drive->add_option("--model", options->model, "Model JSON, or fit:fopdt, fit:sopdt, fit:niopdt, fit:integrator")
        ->required();
    of_drive->add_option("--log", options->logs, "Logs that are fitted")->required();
    of_drive->add_option("--validate", options->validate, "Logs that are not: the verdict is taken there");
    of_drive->add_option("--split", options->split_s,
                         "SECONDS: the logs up to there are fitted, the rest of each validates");
    of_drive->add_flag("--refit", options->refit, "Fit the model first");
    of_drive->add_option("--without", options->without, "Effects to leave off the list")->delimiter(',');
    add_column_options(*of_drive, options->columns);
    of_drive->add_option("--json", options->json, "The verdict, schema glsum-gap-1");
    of_drive->add_option("--jobs", options->jobs, "Threads")->check(CLI::PositiveNumber);
    of_drive->callback([options] { run(*options); });
}

}  // namespace cli
