#include "cli/blind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/progress.hpp"
#include "base/sha256.hpp"
#include "cli/drive_files.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/facts.hpp"
#include "drive/stand/blind/without_model.hpp"
#include "gap/drive/start.hpp"

namespace cli {

namespace {

struct Folder {
    std::vector<std::pair<std::string, std::string>> files;  // name, text
};

void check_new(const std::filesystem::path& folder) {
    if (folder.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input, "stand --blind: expected --out FOLDER");
    }
    std::error_code error;
    if (std::filesystem::exists(folder, error) && !std::filesystem::is_empty(folder, error)) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format("{}: expected a folder that is new or empty, found files in it", folder.string()));
    }
}

// The truth, its hash, which is said, and only then the cases.
void write_set(const std::string& sealed, const std::vector<Folder>& cases, std::uint64_t seed,
               const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    base::write_file(folder / "truth.sealed.json", sealed);
    const std::string hash = base::sha256_of(folder / "truth.sealed.json");
    base::write_file(folder / "truth.sha256", base::sha256_line(hash, "truth.sealed.json"));
    fmt::print("sha256 of the sealed truth: {}\n", hash);
    std::fflush(stdout);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto place = folder / stand::blind::name_of_case(i + 1);
        std::filesystem::create_directories(place, error);
        for (const auto& [name, text] : cases[i].files) {
            base::write_file(place / name, text);
        }
    }
    fmt::print("{} cases, seed {}, in {}\n", cases.size(), seed, folder.string());
}

gap::Question question_of(drive::Form form, bool refit, std::vector<gap::Record> train,
                          std::vector<gap::Record> validate) {
    return {
        std::move(form), refit, std::move(train), std::move(validate), std::nullopt, gap::Metric::simulation, {}, 1};
}

// The one place where the base of a case without a model is found.
gap::Question question_without_model(const stand::blind::Facts& facts, std::vector<gap::Record> train,
                                     std::vector<gap::Record> validate) {
    gap::Question question = question_of(gap::form_to_find(), true, std::move(train), std::move(validate));
    question.domain = gap::domain_named(facts.domain);
    question.metric_free = true;
    gap::take_base(question, "fit");
    return question;
}

}  // namespace

void write_blind_cases(std::size_t count, std::uint64_t seed, unsigned jobs, const std::filesystem::path& folder) {
    check_new(folder);
    std::vector<stand::blind::Truth> truths;
    std::vector<Folder> folders;
    {
        base::Progress progress("blind cases", count);
        for (auto& made : stand::blind::make_cases(count, seed, jobs, [&] { progress.advance(); })) {
            truths.push_back(std::move(made.truth));
            folders.push_back({{{"model.json", std::move(made.model)},
                                {"train.csv", std::move(made.train)},
                                {"validate.csv", std::move(made.validate)}}});
        }
    }
    write_set(stand::blind::seal(seed, truths), folders, seed, folder);
}

void write_open_cases(std::size_t count, std::uint64_t seed, unsigned jobs, const std::filesystem::path& folder) {
    check_new(folder);
    std::vector<stand::blind::OpenTruth> truths;
    std::vector<Folder> folders;
    {
        base::Progress progress("blind cases", count);
        for (auto& made : stand::blind::make_open_cases(count, seed, jobs, [&] { progress.advance(); })) {
            truths.push_back(std::move(made.truth));
            Folder& own = folders.emplace_back(Folder{std::move(made.records)});
            own.files.emplace_back("case.json", std::move(made.facts));
        }
    }
    write_set(stand::blind::seal_open(seed, truths), folders, seed, folder);
}

bool is_blind_case(const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / "model.json") || std::filesystem::exists(folder / "case.json");
}

gap::Question blind_question(const std::filesystem::path& folder) {
    const auto logs = [&](const std::string& name) {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() == ".csv" && entry.path().filename().string().starts_with(name)) {
                found.push_back(entry.path());
            }
        }
        std::sort(found.begin(), found.end());
        return read_records(found, {});
    };
    if (std::filesystem::exists(folder / "model.json")) {
        return question_of(gap::form_of(read_model((folder / "model.json").string())), false, logs("train"),
                           logs("validate"));
    }
    constexpr std::size_t most_bytes = 1U << 16U;
    const auto told = folder / "case.json";
    const auto facts = stand::blind::parse_facts(base::read_file(told, most_bytes), told.string());
    return question_without_model(facts, logs("train"), logs("validate"));
}

}  // namespace cli
