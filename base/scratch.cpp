#include "base/scratch.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

#include "base/failure.hpp"

namespace base {

namespace {

constexpr std::string_view prefix = "glsum-";

// Removes the folders of runs that were killed.
void sweep(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        pid_t owner = 0;
        if (name.starts_with(prefix) &&
            std::from_chars(name.data() + prefix.size(), name.data() + name.size(), owner).ec == std::errc{} &&
            kill(owner, 0) != 0 && errno == ESRCH) {
            std::filesystem::remove_all(entry.path(), ignored);
        }
    }
}

}  // namespace

Scratch::Scratch() {
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    sweep(folder);
    std::string name = (folder / fmt::format("{}{}-XXXXXX", prefix, getpid())).string();
    if (mkdtemp(name.data()) == nullptr) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{}: cannot make a folder: {}", name, std::strerror(errno)));
    }
    path_ = name;
}

Scratch::~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace base
