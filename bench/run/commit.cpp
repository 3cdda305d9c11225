#include "bench/run/commit.hpp"

#include <fmt/format.h>

#include <fstream>

#include "bench/run/first_line.hpp"

namespace bench {
namespace {

std::string first_line_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    return line;
}

// A branch's name, or the hash itself.
std::string checked_out(const std::filesystem::path& checkout) {
    const std::string ref = "ref: ";
    const std::string head = first_line_of(checkout / ".git" / "HEAD");
    return head.starts_with(ref) ? first_line_of(checkout / ".git" / head.substr(ref.size())) : head;
}

}  // namespace

Commit commit_of(const std::filesystem::path& checkout) {
    const std::string git = fmt::format("git -C '{}' ", checkout.string());
    Commit commit;
    if (const std::string hash = first_line(git + "rev-parse HEAD 2>/dev/null"); !hash.empty()) {
        commit.hash = hash;
        commit.dirty =
            first_line(git + "status --porcelain --untracked-files=no 2>/dev/null").empty() ? "false" : "true";
    } else if (const std::string kept = checked_out(checkout); !kept.empty()) {
        commit.hash = kept;
    }
    return commit;
}

}  // namespace bench
