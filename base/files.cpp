#include "base/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <system_error>

#include "base/failure.hpp"

namespace base {
namespace {

constexpr std::string_view marker = ".partial-";

[[noreturn]] void fail(const std::filesystem::path& partial, const std::filesystem::path& path, int reason) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: cannot write: {}; what was there before is untouched",
                                                             path.string(), std::strerror(reason)));
}

}  // namespace

std::filesystem::path partial_name(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    const std::string stem = path.filename().string() + std::string(marker);
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        pid_t owner = 0;
        if (name.starts_with(stem) &&
            std::from_chars(name.data() + stem.size(), name.data() + name.size(), owner).ec == std::errc{} &&
            kill(owner, 0) != 0 && errno == ESRCH) {
            std::filesystem::remove(entry.path(), ignored);
        }
    }
    return folder / fmt::format("{}{}", stem, getpid());
}

void publish(const std::filesystem::path& partial, const std::filesystem::path& path) {
    const int file = open(partial.c_str(), O_RDONLY | O_CLOEXEC);
    const bool synced = file >= 0 && fsync(file) == 0;
    const int reason = errno;
    if (file >= 0) {
        close(file);
    }
    if (!synced) {
        fail(partial, path, reason);
    }
    if (rename(partial.c_str(), path.c_str()) != 0) {
        fail(partial, path, errno);
    }
}

void write_file(const std::filesystem::path& path, const std::string& content) {
    const std::filesystem::path partial = partial_name(path);
    const int file = open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) {
        fail(partial, path, errno);
    }
    for (std::size_t done = 0; done < content.size();) {
        const ssize_t wrote = write(file, content.data() + done, content.size() - done);
        if (wrote < 0 && errno != EINTR) {
            const int reason = errno;
            close(file);
            fail(partial, path, reason);
        }
        done += wrote > 0 ? static_cast<std::size_t>(wrote) : 0;
    }
    if (close(file) != 0) {
        fail(partial, path, errno);
    }
    publish(partial, path);
}

std::string read_file(const std::filesystem::path& path, std::size_t limit) {
    const auto refuse = [&](int reason) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: cannot read: {}", path.string(), std::strerror(reason)));
    };
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) {
        refuse(errno);
    }
    struct stat info {};
    std::string content;
    // A pipe has no size beforehand: what is read decides.
    if (fstat(file, &info) == 0 && S_ISREG(info.st_mode)) {
        content.reserve(std::min(limit, static_cast<std::size_t>(info.st_size)) + 1);
    }
    char buffer[1 << 16];
    for (;;) {
        const ssize_t got = read(file, buffer, sizeof buffer);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            const int reason = errno;
            close(file);
            refuse(reason);
        }
        if (got == 0) {
            break;
        }
        content.append(buffer, static_cast<std::size_t>(got));
        if (content.size() > limit) {
            close(file);
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("{}: expected a file of at most {} bytes", path.string(), limit));
        }
    }
    close(file);
    return content;
}

void check_writable(const std::filesystem::path& path) {
    const std::filesystem::path partial = partial_name(path);
    const int file = open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) {
        fail(partial, path, errno);
    }
    close(file);
    std::filesystem::remove(partial);
}

void check_new_or_empty(const std::filesystem::path& folder) {
    std::error_code error;
    if (std::filesystem::exists(folder, error) && !std::filesystem::is_empty(folder, error)) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format("{}: expected a folder that is new or empty, found files in it", folder.string()));
    }
}

}  // namespace base
