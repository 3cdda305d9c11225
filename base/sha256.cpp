#include "base/sha256.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "base/failure.hpp"

namespace base {
namespace {

bool is_hash(const std::string& text) {
    return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) {
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return text + "'";
}

}  // namespace

std::string sha256_of(const std::filesystem::path& file) {
    const std::string command = fmt::format("sha256sum 2>/dev/null < {}", quoted(file.string()));
    char digits[65] = {};
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    if (!pipe || std::fread(digits, 1, 64, pipe.get()) != 64 || !is_hash(digits)) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: cannot be read and hashed by sha256sum", file.string()));
    }
    return digits;
}

std::vector<std::pair<std::string, std::string>> parse_sha256_lines(const std::string& text, const std::string& name) {
    std::vector<std::pair<std::string, std::string>> lines;
    std::istringstream stream(text);
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        if (line.size() < 67 || !is_hash(line.substr(0, 64)) || line[64] != ' ') {
            throw glsum::Failure(
                glsum::Exit::bad_input,
                fmt::format("{}:{}: expected a hash of 64 digits, two spaces and a file's name, found {}", name, number,
                            line.empty() ? "nothing" : "'" + line.substr(0, 80) + "'"));
        }
        lines.emplace_back(line.substr(0, 64), line.substr(66));
    }
    return lines;
}

void check_sha256(const std::filesystem::path& file, const std::string& expected, const std::string& noted_in) {
    const std::string found = sha256_of(file);
    if (found != expected) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: expected the sha256 {} of {}, found {}: it was changed since",
                                         file.string(), expected, noted_in, found));
    }
}

std::string sha256_line(const std::string& hash, const std::string& file_name) {
    return fmt::format("{}  {}\n", hash, file_name);
}

}  // namespace base
