// glsum score: verdicts on blind cases against the truth that was sealed.
#include "cli/score.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "bench/files.hpp"
#include "bench/sha256.hpp"
#include "drive/stand/blind/score.hpp"
#include "qemu/failure.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;
namespace blind = stand::blind;

constexpr std::size_t most_bytes = 64u << 20;

struct Options {
    std::filesystem::path folder;
    std::string truth_hash;
    bool goals = false;
    std::filesystem::path json;
};

// The text of a file that has the hash which was written down for it.
std::string read_hashed(const std::filesystem::path& path, const std::string& expected, const std::string& noted_in) {
    const std::string found = bench::sha256_of(path);
    if (found != expected) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected the sha256 {} of {}, found {}: it was changed since",
                                                   path.string(), expected, noted_in, found));
    }
    return bench::read_file(path, most_bytes);
}

std::vector<blind::SealedCase> open_truth(const Options& options) {
    const auto noted = options.folder / "truth.sha256";
    const auto lines = bench::parse_sha256_lines(bench::read_file(noted, most_bytes), noted.string());
    if (lines.size() != 1 || lines[0].second != "truth.sealed.json") {
        throw Failure(Exit::bad_input, fmt::format("{}: expected one line, of truth.sealed.json, found {}",
                                                   noted.string(), lines.size()));
    }
    if (!options.truth_hash.empty() && options.truth_hash != lines[0].first) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected {}, as --truth-sha256 says, found {}", noted.string(),
                                                   options.truth_hash, lines[0].first));
    }
    const auto path = options.folder / "truth.sealed.json";
    return blind::parse_sealed(read_hashed(path, lines[0].first, noted.string()), path.string());
}

std::vector<blind::Answer> open_verdicts(const Options& options, const std::vector<blind::SealedCase>& truths) {
    const auto noted = options.folder / "verdicts.sha256";
    std::map<std::string, std::string> hashes;
    for (const auto& [hash, file] : bench::parse_sha256_lines(bench::read_file(noted, most_bytes), noted.string())) {
        if (!hashes.emplace(file, hash).second) {
            throw Failure(Exit::bad_input, fmt::format("{}: {} is there twice", noted.string(), file));
        }
    }
    std::vector<blind::Answer> answers;
    for (const blind::SealedCase& truth : truths) {
        const std::string file = truth.name + "/verdict.json";
        const auto found = hashes.find(file);
        if (found == hashes.end()) {
            throw Failure(Exit::bad_input, fmt::format("{}: expected a line for {}, found none: diagnose --batch {} "
                                                       "answers every case",
                                                       noted.string(), file, options.folder.string()));
        }
        const auto path = options.folder / file;
        answers.push_back(blind::parse_answer(read_hashed(path, found->second, noted.string()), path.string()));
        hashes.erase(found);
    }
    if (!hashes.empty()) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected cases of the sealed truth, found {}", noted.string(),
                                                   hashes.begin()->first));
    }
    return answers;
}

void run(const Options& options) {
    // The verdicts are fixed before the truth is opened: both by their hashes.
    const std::vector<blind::SealedCase> truths = open_truth(options);
    const std::vector<blind::Answer> answers = open_verdicts(options, truths);
    const std::vector<blind::Scored> scored{
        {"verdicts", blind::score(truths, answers)},
        {"constant guess: no_gap", blind::score(truths, blind::constant_guess(truths.size()))}};
    fmt::print("{} cases of {}\n\n{}", truths.size(), options.folder.string(), blind::to_text(scored));
    if (!options.json.empty()) {
        bench::write_file(options.json, blind::to_json(scored));
    }
    const std::vector<std::string> missed = blind::missed_goals(scored.front().score);
    for (const std::string& goal : missed) {
        fmt::print("not reached: {}\n", goal);
    }
    if (options.goals && !missed.empty()) {
        throw Failure(Exit::check_failed, fmt::format("score: {} goals are not reached", missed.size()));
    }
}

}  // namespace

void add_score(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("score", "Verdicts on blind cases against the truth that was sealed");
    command->footer(
        "Exits 2 where a verdict or the truth is not what its hash says.\n"
        "Example: glsum stand --blind 100 --seed 7 --out build/blind && glsum diagnose --batch build/blind && glsum "
        "score build/blind");
    command->add_option("folder", options->folder, "Of stand --blind, answered by diagnose --batch")->required();
    command->add_option("--truth-sha256", options->truth_hash, "What stand --blind printed first");
    command->add_flag("--goals", options->goals, "Exit 1 unless what is to be reached is");
    command->add_option("--json", options->json, "Write all numbers as JSON");
    command->callback([options] { run(*options); });
}

}  // namespace cli
