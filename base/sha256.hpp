// SHA-256 of files, by coreutils.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace base {

/// 64 hexadecimal digits. \throws glsum::Failure (bad input) naming the file if it cannot be read.
[[nodiscard]] std::string sha256_of(const std::filesystem::path& file);

/// The lines of a file as `sha256sum` writes and checks it: a hash and a name of each. \param name  begins every
/// message \throws glsum::Failure (bad input) naming file, line, what was expected and what was found.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> parse_sha256_lines(const std::string& text,
                                                                                  const std::string& name);

/// \param noted_in  the file that says so, for the message
/// \throws glsum::Failure (bad input) naming the file where its hash is another.
void check_sha256(const std::filesystem::path& file, const std::string& expected, const std::string& noted_in);

/// A line of such a file.
[[nodiscard]] std::string sha256_line(const std::string& hash, const std::string& file_name);

}  // namespace base
