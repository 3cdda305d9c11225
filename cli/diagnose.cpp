// glsum diagnose drive: where a drive and its simulation part, which effect explains it, how far the gap shrinks.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

#include "base/failure.hpp"
#include "base/freed_memory.hpp"
#include "cli/blind.hpp"
#include "cli/command.hpp"
#include "cli/diagnose_cycles.hpp"
#include "cli/drive_files.hpp"
#include "cli/exam.hpp"
#include "cli/output.hpp"
#include "gap/drive/diagnose.hpp"
#include "gap/drive/fair_records.hpp"
#include "gap/drive/start.hpp"
#include "gap/drive/verdict.hpp"

namespace cli {
namespace {

struct Options {
    std::string model;
    std::vector<std::filesystem::path> logs;
    std::vector<std::filesystem::path> validate;
    drive::Columns columns;
    std::optional<double> split_s;
    bool refit = false;
    std::string metric;
    std::optional<double> horizon_s;
    std::string domain;
    std::vector<std::string> without;
    Output json;
    std::filesystem::path html;
    std::filesystem::path improved;
    unsigned jobs = 1;
};

void run(const Options& options, const std::string& line) {
    std::vector<gap::Record> train = read_records(options.logs, options.columns);
    for (const std::string& name : options.without) {
        (void)gap::effect_named(name);
    }
    const bool fitted = options.model == "fit" || options.model.starts_with("fit:");
    gap::Question question{fitted ? gap::form_to_find() : gap::form_of(read_model(options.model)),
                           fitted || options.refit,
                           std::move(train),
                           read_records(options.validate, options.columns),
                           options.split_s,
                           options.metric == "prediction" ? gap::Metric::prediction : gap::Metric::simulation,
                           options.without,
                           options.jobs};
    if (fitted) {
        gap::take_base(question, options.model);
    } else if (options.refit) {
        question.base_name = "the model, refitted";
        question.given_form = true;
    }
    if (!options.domain.empty()) {
        question.domain = gap::domain_named(options.domain);
    }
    question.metric_free = options.metric.empty();
    question.horizon_s = options.horizon_s;
    if (question.split_s && question.validate.empty()) {
        gap::check_split(fmt::format("--split {}", *question.split_s), *question.split_s, question.train);
    }
    gap::check_unseen(question.train, question.validate);
    const gap::Answer answer =
        gap::diagnose(question, [](const std::string& what) { fmt::print(stderr, "{}\n", what); });
    fmt::print("{}", gap::to_text(answer));
    if (options.json.wanted()) {
        options.json.write(gap::to_json(answer));
    }
    if (!options.html.empty()) {
        put(gap::to_html(answer, line), options.html);
    }
    if (!options.improved.empty()) {
        put(gap::improved_model(answer), options.improved);
        for (const std::string& event : gap::events_of(answer)) {
            fmt::print(stderr, "glsum: warning: {}: without {}, an event of one record and not of the model\n",
                       options.improved.string(), event);
        }
    }
}

}  // namespace

void add_options(Command& command, const Words& words) {
    base::keep_freed_memory();  // whatever is asked simulates a million times
    command.takes_one_subcommand();
    auto options = std::make_shared<Options>();
    options->jobs = std::max(1U, std::thread::hardware_concurrency());
    command.add_option("--jobs", options->jobs, "Threads").at_least(1);
    auto set = std::make_shared<std::filesystem::path>();
    command.add_option(
        "--batch", *set,
        "Judge each case of a blind set: DIR/NNN/ with model.json, or case.json where the base is to be found, "
        "train*.csv and validate*.csv; writes DIR/NNN/verdict.json and DIR/verdicts.sha256");
    struct Exam {
        std::filesystem::path manifest;
        std::filesystem::path data;
        std::filesystem::path out;
    };
    auto exam = std::make_shared<Exam>();
    const Option asked = command.add_option(
        "--exam", exam->manifest,
        "Answer each question of a manifest; writes OUT/NAME/verdict.json, or refused.txt, and OUT/answers.sha256");
    command.add_option("--data", exam->data, "Of --exam: the folder of its logs; otherwise the manifest's")
        .needs(asked);
    command.add_option("--out", exam->out, "Of --exam: a folder for the answers, new or empty").needs(asked);
    command.footer(
        "Examples: glsum diagnose drive --model model.json --log train.csv --validate other.csv\n"
        "          glsum diagnose cycles --measured results/silicon/h747_per_sample_fir.csv\n"
        "          glsum diagnose --batch build/blind\n"
        "          glsum diagnose --exam gap/exam/real.json --data logs --out build/exam");
    command.callback([&command, options, set, exam] {
        if (!set->empty()) {
            judge_blind_cases(*set, options->jobs);
        } else if (!exam->manifest.empty()) {
            run_exam(exam->manifest, exam->data, exam->out, options->jobs);
        } else if (!command.given_subcommand()) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 "diagnose: expected drive, cycles, --batch DIR or --exam MANIFEST");
        }
    });
    add_diagnose_cycles(command);
    Command of_drive = command.add_subcommand("drive", "A model of a drive against its logs");
    of_drive.footer(
        "Without --refit the model is judged as it is, its parameters included. With it, or with fit:FORM, its gain, "
        "dynamics,\n"
        "dead time, offset and initial state are fitted first.\n"
        "Example: glsum diagnose drive --model model.json --log train.csv --validate other.csv --json verdict.json");
    of_drive
        .add_option("--model", options->model,
                    "fit: the linear description that does best by itself; fit:FORM: one of a form; or a model JSON")
        .required();
    of_drive.add_option("--log", options->logs, "Logs that are fitted").required();
    of_drive.add_option("--validate", options->validate, "Logs that are not: the verdict is taken there");
    of_drive
        .add_option("--split", options->split_s, "SECONDS: the logs up to there are fitted, the rest of each validates")
        .above(0);
    of_drive.add_flag("--refit", options->refit, "Fit the model first");
    of_drive
        .add_option(
            "--metric", options->metric,
            "simulation, or prediction: for drives that integrate or were logged in a closed loop; simulation unless a "
            "base is found that integrates")
        .one_of({"simulation", "prediction"});
    of_drive
        .add_option("--horizon", options->horizon_s,
                    "SECONDS that a prediction looks ahead; a fiftieth of the record unless given")
        .above(0);
    of_drive
        .add_option("--domain", options->domain,
                    "What the plant is; effects that cannot occur there are left off the list")
        .one_of({"mechanical", "thermal", "hydraulic", "electric"});
    of_drive.add_option("--without", options->without, "Effects to leave off the list").delimiter(',');
    add_diagnosis_column_options(of_drive, options->columns);
    options->json.add_to(of_drive, "--json", "The verdict, schema glsum-gap-1");
    of_drive.add_option("--html", options->html, "A page with curves, ranking and where the gap lies");
    of_drive.add_option("--improved", options->improved, "The model with the effect, which simulate runs");
    of_drive.add_option("--jobs", options->jobs, "Threads").at_least(1);
    of_drive.callback([options, line = words.line] { run(*options, line); });
}

}  // namespace cli
