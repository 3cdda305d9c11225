// glsum score: verdicts on blind cases against the truth that was sealed.
#include "cli/command.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <thread>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/gnuplot.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "cli/blind.hpp"
#include "cli/exam.hpp"
#include "cli/output.hpp"
#include "drive/stand/blind/judge.hpp"
#include "drive/stand/blind/score.hpp"
#include "drive/stand/blind/set_folder.hpp"
#include "gap/drive/oracle.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;
namespace blind = stand::blind;

struct Options {
    std::filesystem::path folder;
    std::filesystem::path exam;
    std::filesystem::path truth;
    std::string truth_hash;
    bool goals = false;
    bool no_oracle = false;
    unsigned jobs = 1;
    Output json;
    std::filesystem::path plot;
};

void check_truth_hash(const Options& options) {
    const std::string noted = blind::noted_hash(options.folder);
    if (!options.truth_hash.empty() && options.truth_hash != noted) {
        throw Failure(Exit::bad_input,
                      fmt::format("{}: expected {}, as --truth-sha256 says, found {}",
                                  (options.folder / blind::truth_hash_file).string(), options.truth_hash, noted));
    }
}

// Of each case, what could have been known; of one that cannot be diagnosed at all, nothing, and it is said why.
std::vector<std::optional<gap::Foresight>> foresee_all(const Options& options,
                                                       const std::vector<blind::SealedCase>& truths) {
    std::vector<std::optional<gap::Foresight>> all(truths.size());
    std::vector<std::string> faults(truths.size());
    base::Progress progress("true effects refitted", truths.size());
    base::parallel_for(truths.size(), options.jobs, [&](std::size_t i) {
        try {
            all[i] = gap::foresee(blind_question(options.folder / truths[i].name), truths[i].effects);
        } catch (const Failure& failure) {
            faults[i] = failure.what();
        }
        progress.advance();
    });
    for (std::size_t i = 0; i < truths.size(); ++i) {
        if (!all[i]) {
            fmt::print(stderr, "{}: not counted as identifiable: {}\n", truths[i].name, faults[i]);
        }
    }
    return all;
}

std::optional<blind::Oracle> oracle_of(const std::optional<gap::Foresight>& known) {
    return known ? std::optional(
                       blind::Oracle{known->lead >= blind::identifiable_lead, known->gap_base, known->gap_after})
                 : std::nullopt;
}

std::vector<blind::Answer> answers_by(const std::vector<std::optional<gap::Foresight>>& all,
                                      std::string gap::Foresight::*criterion) {
    std::vector<blind::Answer> answers;
    for (const auto& foresight : all) {
        answers.push_back(blind::answer_naming(foresight ? (*foresight).*criterion : "none"));
    }
    return answers;
}

// What is not reached is said, and with --goals is a failure.
void tell_goals(const Options& options, const std::vector<std::string>& missed) {
    for (const std::string& goal : missed) {
        fmt::print("not reached: {}\n", goal);
    }
    if (options.goals && !missed.empty()) {
        throw Failure(Exit::check_failed, fmt::format("score: {} goals are not reached", missed.size()));
    }
}

void write_results(const Options& options, const std::string& json, const std::vector<blind::Claim>& claims) {
    if (options.json.wanted()) {
        options.json.write(json);
    }
    if (!options.plot.empty()) {
        base::draw(blind::picture_of_calibration(claims), options.plot);
    }
}

// Cases with a model: verdicts beside an oracle and beside plain criteria.
void score_with_models(const Options& options, const std::vector<blind::SealedCase>& truths,
                       const std::vector<blind::Answer>& answers) {
    std::vector<std::optional<gap::Foresight>> foresights;
    std::vector<std::optional<blind::Oracle>> oracle;
    if (!options.no_oracle) {
        foresights = foresee_all(options, truths);
        for (const auto& foresight : foresights) {
            oracle.push_back(oracle_of(foresight));
        }
    }
    std::vector<blind::Scored> scored;
    const auto add = [&](const char* name, const std::vector<blind::Answer>& given) {
        scored.push_back({name, blind::score(truths, given, oracle)});
    };
    add("verdicts", answers);
    add("constant guess: no_gap", blind::constant_guess(truths.size()));
    if (!options.no_oracle) {
        add("plain BIC", answers_by(foresights, &gap::Foresight::by_plain_bic));
        add("prewhitened BIC", answers_by(foresights, &gap::Foresight::by_whitened_bic));
    }
    fmt::print("{} cases of {}\n\n{}", truths.size(), options.folder.string(), blind::to_text(scored));
    write_results(options, blind::to_json(scored), scored.front().score.claims);
    tell_goals(options, blind::missed_goals(scored.front().score));
}

void score_without_models(const Options& options, const std::vector<blind::SealedCase>& truths,
                          const std::vector<blind::Answer>& answers) {
    const blind::OpenScore scored = blind::score_open(truths, answers);
    fmt::print("{} cases of {}, without models\n\n{}", truths.size(), options.folder.string(), blind::to_text(scored));
    write_results(options, blind::to_json(scored), scored.claims);
    tell_goals(options, blind::missed_goals(scored));
}

void run(const Options& options) {
    // The verdicts are fixed before the truth is opened: both by their hashes.
    check_truth_hash(options);
    const std::vector<blind::SealedCase> truths = blind::open_truth(options.folder);
    const std::vector<blind::Answer> answers = blind::open_verdicts(options.folder, truths);
    (truths.front().fitted_base ? score_without_models : score_with_models)(options, truths, answers);
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "A set of --no-model is scored by points; its rules and goals are in drive/stand/blind/README.md.\n"
        "Exits 2 where a verdict or the truth is not what its hash says.\n"
        "Example: glsum stand --blind 100 --seed 7 --out build/blind && glsum diagnose --batch build/blind && glsum "
        "score build/blind\n"
        "         glsum score --exam build/exam --truth gap/exam/real_truth.json");
    command.add_option("folder", options->folder, "Of stand --blind, answered by diagnose --batch");
    const Option exam = command.add_option("--exam", options->exam, "Instead: the answers of diagnose --exam");
    command.add_option("--truth", options->truth, "Of --exam: what is known, a JSON file").needs(exam);
    command.add_option("--truth-sha256", options->truth_hash, "What stand --blind printed first");
    command.add_flag(
        "--no-oracle", options->no_oracle,
        "Without the true effects refitted: says nothing of what is identifiable, and takes no time; a set "
        "without models has none");
    options->jobs = std::max(1U, std::thread::hardware_concurrency());
    command.add_option("--jobs", options->jobs, "Threads").at_least(1);
    command.add_flag("--goals", options->goals, "Exit 1 unless what is to be reached is");
    options->json.add_to(command, "--json", "All numbers");
    command.add_option("--plot", options->plot,
                       "Draw how often answers are right by their confidence: STEM.svg and STEM.png");
    command.callback([options] {
        if (options->exam.empty() == options->folder.empty()) {
            throw Failure(Exit::bad_input, "score: expected the folder of a blind set or --exam DIR, one of them");
        }
        options->exam.empty() ? run(*options) : score_exam(options->exam, options->truth, options->json);
    });
}

}  // namespace cli
