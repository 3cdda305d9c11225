#include "cli/blind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/sha256.hpp"
#include "cli/drive_files.hpp"
#include "drive/stand/blind/facts.hpp"
#include "drive/stand/blind/set_folder.hpp"
#include "gap/drive/diagnose.hpp"
#include "gap/drive/start.hpp"
#include "gap/drive/verdict.hpp"

namespace cli {

namespace {

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
    if (std::filesystem::exists(folder / stand::blind::model_file)) {
        return question_of(gap::form_of(read_model((folder / stand::blind::model_file).string())), false, logs("train"),
                           logs("validate"));
    }
    constexpr std::size_t most_bytes = 1U << 16U;
    const auto told = folder / stand::blind::facts_file;
    const auto facts = stand::blind::parse_facts(base::read_file(told, most_bytes), told.string());
    return question_without_model(facts, logs("train"), logs("validate"));
}

void judge_blind_cases(const std::filesystem::path& set, unsigned jobs) {
    std::vector<std::filesystem::path> cases;
    std::error_code unreadable;
    for (const auto& entry : std::filesystem::directory_iterator(set, unreadable)) {
        if (stand::blind::is_case(entry.path())) {
            cases.push_back(entry.path());
        }
    }
    if (cases.empty()) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format(
                "--batch {}: expected folders with model.json or case.json, train*.csv and validate*.csv, found none",
                set.string()));
    }
    std::sort(cases.begin(), cases.end());
    std::vector<std::string> verdicts(cases.size());
    std::vector<std::string> failures(cases.size());
    {
        base::Progress progress("cases", cases.size());
        base::parallel_for(cases.size(), jobs, [&](std::size_t i) {
            try {
                const gap::Answer answer = gap::diagnose(blind_question(cases[i]), [](const std::string&) {});
                put(gap::to_json(answer), cases[i] / stand::blind::verdict_file);
                verdicts[i] = gap::name_of(answer.decision.outcome);
            } catch (const glsum::Failure& failure) {
                failures[i] = failure.what();
            }
            progress.advance();
        });
    }
    std::string hashes;
    std::size_t failed = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const std::string name = cases[i].filename().string();
        if (!failures[i].empty()) {
            fmt::print(stderr, "glsum: {}: {}\n", name, failures[i]);
            ++failed;
            continue;
        }
        fmt::print("{}  {}\n", name, verdicts[i]);
        hashes += base::sha256_line(base::sha256_of(cases[i] / stand::blind::verdict_file),
                                    name + "/" + stand::blind::verdict_file);
    }
    put(hashes, set / stand::blind::verdict_hashes_file);
    if (failed > 0) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{} of {} cases have no verdict", failed, cases.size()));
    }
}

}  // namespace cli
