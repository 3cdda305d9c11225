#include "base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace base {

Progress::Progress(std::string title, std::size_t total)
    : title_(std::move(title)),
      total_(std::max<std::size_t>(total, 1)),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      shown_(start_) {
    show();
}

Progress::~Progress() {
    if (terminal_) {
        fmt::print(stderr, "\n");
    }
}

void Progress::advance(std::size_t steps) {
    const std::lock_guard lock(mutex_);
    done_ += steps;
    const auto now = std::chrono::steady_clock::now();
    if (terminal_ ? (now - shown_ > std::chrono::milliseconds(50) || done_ >= total_)
                  : done_ * 10 / total_ > shown_tenth_) {
        shown_ = now;
        show();
    }
}

std::string Progress::remaining(double seconds) const {
    if (done_ == 0 || done_ >= total_) {
        return "";
    }
    return fmt::format(", {:.0f} s left", seconds / static_cast<double>(done_) * static_cast<double>(total_ - done_));
}

void Progress::show() {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    shown_tenth_ = done_ * 10 / total_;
    std::fflush(stdout);  // or a line of what both write to might end behind this one
    if (!terminal_) {
        fmt::print(stderr, "{}: {} of {}, {:.0f} s\n", title_, done_, total_, seconds);
        return;
    }
    constexpr std::size_t width = 30;
    const std::size_t filled = std::min(width, done_ * width / total_);
    fmt::print(stderr, "\r{:<26} [{:#<{}}{:.<{}}] {}/{} {:.0f} s{:<16}", title_, "", filled, "", width - filled, done_,
               total_, seconds, remaining(seconds));
    std::fflush(stderr);
}

}  // namespace base
