#include "drive/stand/blind/set_folder.hpp"

#include <fmt/format.h>

#include <map>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/sha256.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/without_model.hpp"

namespace stand::blind {
namespace {

using glsum::Exit;
using glsum::Failure;

constexpr std::size_t most_bytes = 64u << 20;

std::vector<std::pair<std::string, std::string>> noted_in(const std::filesystem::path& file) {
    return base::parse_sha256_lines(base::read_file(file, most_bytes), file.string());
}

// The text of a file that has the hash which was written down for it.
std::string read_hashed(const std::filesystem::path& file, const std::string& expected, const std::string& noted_in) {
    base::check_sha256(file, expected, noted_in);
    return base::read_file(file, most_bytes);
}

}  // namespace

Set make_set(std::size_t count, std::uint64_t seed, unsigned jobs, const std::function<void()>& done) {
    Set set;
    std::vector<Truth> truths;
    for (auto& made : make_cases(count, seed, jobs, done)) {
        truths.push_back(std::move(made.truth));
        set.cases.push_back({{model_file, std::move(made.model)},
                             {"train.csv", std::move(made.train)},
                             {"validate.csv", std::move(made.validate)}});
    }
    set.sealed = seal(seed, truths);
    return set;
}

Set make_open_set(std::size_t count, std::uint64_t seed, unsigned jobs, const std::function<void()>& done) {
    Set set;
    std::vector<OpenTruth> truths;
    for (auto& made : make_open_cases(count, seed, jobs, done)) {
        truths.push_back(std::move(made.truth));
        set.cases.push_back(std::move(made.records));
        set.cases.back().emplace_back(facts_file, std::move(made.facts));
    }
    set.sealed = seal_open(seed, truths);
    return set;
}

void write_set(const Set& set, const std::filesystem::path& folder,
               const std::function<void(const std::string& hash)>& sealed) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    base::write_file(folder / truth_file, set.sealed);
    const std::string hash = base::sha256_of(folder / truth_file);
    base::write_file(folder / truth_hash_file, base::sha256_line(hash, truth_file));
    sealed(hash);
    for (std::size_t i = 0; i < set.cases.size(); ++i) {
        const auto own = folder / name_of_case(i + 1);
        std::filesystem::create_directories(own, error);
        for (const auto& [name, text] : set.cases[i]) {
            base::write_file(own / name, text);
        }
    }
}

bool is_case(const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / model_file) || std::filesystem::exists(folder / facts_file);
}

std::string noted_hash(const std::filesystem::path& folder) {
    const auto noted = folder / truth_hash_file;
    const auto lines = noted_in(noted);
    if (lines.size() != 1 || lines[0].second != truth_file) {
        throw Failure(Exit::bad_input,
                      fmt::format("{}: expected one line, of {}, found {}", noted.string(), truth_file, lines.size()));
    }
    return lines[0].first;
}

std::vector<SealedCase> open_truth(const std::filesystem::path& folder) {
    const auto path = folder / truth_file;
    return parse_sealed(read_hashed(path, noted_hash(folder), (folder / truth_hash_file).string()), path.string());
}

std::vector<Answer> open_verdicts(const std::filesystem::path& folder, const std::vector<SealedCase>& truths) {
    const auto noted = folder / verdict_hashes_file;
    std::map<std::string, std::string> hashes;
    for (const auto& [hash, file] : noted_in(noted)) {
        if (!hashes.emplace(file, hash).second) {
            throw Failure(Exit::bad_input, fmt::format("{}: {} is there twice", noted.string(), file));
        }
    }
    std::vector<Answer> answers;
    for (const SealedCase& truth : truths) {
        const std::string file = fmt::format("{}/{}", truth.name, verdict_file);
        const auto found = hashes.find(file);
        if (found == hashes.end()) {
            throw Failure(Exit::bad_input, fmt::format("{}: expected a line for {}, found none: diagnose --batch {} "
                                                       "answers every case",
                                                       noted.string(), file, folder.string()));
        }
        const auto path = folder / file;
        answers.push_back(parse_answer(read_hashed(path, found->second, noted.string()), path.string()));
        hashes.erase(found);
    }
    if (!hashes.empty()) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected cases of the sealed truth, found {}", noted.string(),
                                                   hashes.begin()->first));
    }
    return answers;
}

}  // namespace stand::blind
