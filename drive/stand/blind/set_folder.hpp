// A blind set as a folder: its truth sealed under a hash, its cases, and what was said of them, under hashes too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "drive/stand/blind/score.hpp"

namespace stand::blind {

/// The names of a set's files, in its folder and in that of a case.
inline constexpr const char* truth_file = "truth.sealed.json";
inline constexpr const char* truth_hash_file = "truth.sha256";
inline constexpr const char* verdict_hashes_file = "verdicts.sha256";
inline constexpr const char* verdict_file = "verdict.json";
inline constexpr const char* model_file = "model.json";
inline constexpr const char* facts_file = "case.json";

struct Set {
    using File = std::pair<std::string, std::string>;  ///< name, text
    std::string sealed;
    std::vector<std::vector<File>> cases;
};

/// Cases with models, and without. \param done  called after each
[[nodiscard]] Set make_set(std::size_t count, std::uint64_t seed, unsigned jobs, const std::function<void()>& done);
[[nodiscard]] Set make_open_set(std::size_t count, std::uint64_t seed, unsigned jobs,
                                const std::function<void()>& done);

/// The truth first. \param sealed  told its hash before any case is written
void write_set(const Set& set, const std::filesystem::path& folder,
               const std::function<void(const std::string& hash)>& sealed);

/// Whether a folder is one of a case.
[[nodiscard]] bool is_case(const std::filesystem::path& folder);

/// The hash of the truth that was written down beside it.
[[nodiscard]] std::string noted_hash(const std::filesystem::path& folder);

/// Each throws glsum::Failure (bad input) naming the file: one that is not what its hash says, a case without a line
/// or with two, a line without a case.
[[nodiscard]] std::vector<SealedCase> open_truth(const std::filesystem::path& folder);
/// In the order of the truths.
[[nodiscard]] std::vector<Answer> open_verdicts(const std::filesystem::path& folder,
                                                const std::vector<SealedCase>& truths);

}  // namespace stand::blind
