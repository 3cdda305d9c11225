// Files: read with a bound, written whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace base {

/// A name beside `path` to write to before it is renamed. Removes what killed runs left under such names.
[[nodiscard]] std::filesystem::path partial_name(const std::filesystem::path& path);

/// Puts the finished partial file in the place of `path`, on the disk before it is seen.
/// \throws glsum::Failure (bad input) naming the file and the reason; the partial file is removed then.
void publish(const std::filesystem::path& partial, const std::filesystem::path& path);

/// Writes a whole file. \throws glsum::Failure as `publish`.
void write_file(const std::filesystem::path& path, const std::string& content);

/// Reads a whole file of at most `limit` bytes.
/// \throws glsum::Failure (bad input) naming the file and the reason.
[[nodiscard]] std::string read_file(const std::filesystem::path& path, std::size_t limit);

/// Fails now rather than after a long run: whether a file can be written there.
void check_writable(const std::filesystem::path& path);

/// \throws glsum::Failure (bad input) naming the folder if there is anything in it.
void check_new_or_empty(const std::filesystem::path& folder);

}  // namespace base
