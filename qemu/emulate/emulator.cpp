#include "qemu/emulate/emulator.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>

#include "base/failure.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

constexpr std::size_t longest_line = 64U << 10;

// A child with one pipe for its output and errors. It is killed when this object goes, and when this process dies.
class Child {
public:
    Child(const std::filesystem::path& command, const std::vector<std::string>& arguments, const std::string& plugin,
          std::chrono::seconds grace)
        : grace_(grace) {
        std::vector<std::string> words{command.string()};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) {
            argv.push_back(word.data());
        }
        argv.push_back(nullptr);
        int ends[2];
        if (pipe(ends) != 0 || (id_ = fork()) < 0) {
            throw Failure(Exit::check_failed,
                          fmt::format("cannot start {}: {}", command.string(), std::strerror(errno)));
        }
        if (id_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            dup2(ends[1], STDOUT_FILENO);
            dup2(ends[1], STDERR_FILENO);
            close(ends[0]);
            close(ends[1]);
            plugin.empty() ? unsetenv("GLSUM_QEMU_PLUGIN") : setenv("GLSUM_QEMU_PLUGIN", plugin.c_str(), 1);
            execv(argv[0], argv.data());
            _exit(127);
        }
        close(ends[1]);
        output_ = ends[0];
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (id_ > 0) {
            kill(id_, SIGTERM);
            const auto until = std::chrono::steady_clock::now() + grace_;
            while (std::chrono::steady_clock::now() < until && waitpid(id_, nullptr, WNOHANG) == 0) {
                usleep(20'000);
            }
            kill(id_, SIGKILL);
            waitpid(id_, nullptr, 0);
        }
        close(output_);
    }

    /// Appends what the child wrote. \return false at the end of its output.
    /// \throws Failure when it stays silent for longer than the limit.
    bool read_some(std::string& text, std::chrono::seconds silence_limit) {
        pollfd waiting{output_, POLLIN, 0};
        const auto limit = std::chrono::milliseconds(silence_limit).count();
        const int ready = poll(&waiting, 1, static_cast<int>(limit));
        if (ready < 0 && errno == EINTR) {
            return true;
        }
        if (ready == 0) {
            if (is_only_slow(silence_limit)) {
                return true;
            }
            throw Failure(Exit::check_failed, fmt::format("the emulator was silent for {} s and was ended",
                                                          silence_limit.count() * (silences_ + 1)));
        }
        heard_at_ = processor_time();
        silences_ = 0;
        std::array<char, 4096> buffer;
        const ssize_t got = read(output_, buffer.data(), buffer.size());
        if (got <= 0) {
            return false;
        }
        text.append(buffer.data(), static_cast<std::size_t>(got));
        return true;
    }

    int wait() {
        int status = 0;
        while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
        }
        id_ = -1;
        return status;
    }

private:
    // What it has used since it started.
    [[nodiscard]] std::chrono::duration<double> processor_time() const {
        clockid_t clock{};
        timespec used{};
        if (clock_getcpuclockid(id_, &clock) != 0 || clock_gettime(clock, &used) != 0) {
            return {};
        }
        return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
    }

    // Where others take the processor a row lasts longer. What hangs uses none of it, and what runs in circles as much
    // as there is; ten limits end either.
    bool is_only_slow(std::chrono::seconds silence_limit) {
        constexpr int most_silences = 9;
        constexpr double least_share = 0.05;
        const auto used = processor_time() - heard_at_;
        return used > least_share * silence_limit * (silences_ + 1) && used < 0.9 * silence_limit &&
               ++silences_ <= most_silences;
    }

    std::chrono::seconds grace_;
    pid_t id_ = -1;
    int output_ = -1;
    std::chrono::duration<double> heard_at_{};  // of its processor time
    int silences_ = 0;                          // whole limits since it was heard
};

}  // namespace

std::string emulator_version() {
    const char* chosen = std::getenv("GLSUM_QEMU");
    const std::string command =
        fmt::format("'{}' --version 2>/dev/null", chosen != nullptr ? chosen : "qemu-system-arm");
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    char line[256] = "";
    if (!pipe || std::fgets(line, sizeof line, pipe.get()) == nullptr) {
        throw Failure(Exit::missing,
                      "qemu-system-arm: not found; expected QEMU 7.2 or later (Debian package qemu-system-arm)");
    }
    std::string version(line);
    version.erase(version.find_last_not_of('\n') + 1);
    return version;
}

void emulate(const Emulator& emulator, const std::filesystem::path& elf, const std::vector<std::string>& arguments,
             const std::string& plugin, const std::function<void(const std::string&)>& line) {
    std::vector<std::string> words{elf.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    Child child(emulator.command, words, plugin, emulator.grace);
    std::string text;
    std::string fatal;  // what the emulator died of, before its dump of all registers
    std::string tail;   // the last lines, for the message when it fails
    for (bool more = true; more;) {
        more = child.read_some(text, emulator.silence_limit);
        if (text.size() > longest_line && text.find('\n') == std::string::npos) {
            throw Failure(Exit::check_failed, fmt::format("{} wrote a line of more than {} bytes: {}...",
                                                          elf.filename().string(), longest_line, text.substr(0, 60)));
        }
        for (std::size_t end; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1)) {
            const std::string one = text.substr(0, end);
            if (one.starts_with("qemu: fatal: ")) {
                fatal = one.substr(sizeof "qemu: fatal: " - 1);
            } else if (!fatal.empty() && one.find("R15=") != std::string::npos) {
                fatal += ", " + one.substr(one.find("R15="));
            }
            tail = (tail + "\n  " + one).substr(tail.size() > 1000 ? tail.find('\n', 1) : 0);
            line(one);
        }
    }
    const int status = child.wait();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        return;
    }
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    const std::string how = WIFSIGNALED(status) ? fmt::format("was ended by signal {}", WTERMSIG(status))
                                                : fmt::format("exited with {}", code);
    if (!fatal.empty()) {
        throw Failure(Exit::check_failed,
                      fmt::format("{} under the emulator {}: {}", elf.filename().string(), how, fatal));
    }
    const std::string said = tail + (text.empty() ? "" : "\n  " + text);
    throw Failure(code == 3 ? Exit::missing : Exit::check_failed,
                  fmt::format("{} under the emulator {}{}{}", elf.filename().string(), how,
                              said.empty() ? "" : "; it said:", said));
}

}  // namespace qemu
