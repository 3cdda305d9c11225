// Progress of long work: a bar with what remains on a terminal, a plain line every tenth elsewhere. Thread-safe.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace base {

class Progress {
public:
    /// Shown on standard error, where it does not mix with results.
    Progress(std::string title, std::size_t total);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();
    void advance(std::size_t steps = 1);

private:
    void show();
    /// As if the rest took as long a step as what is done; on a terminal.
    [[nodiscard]] std::string remaining(double seconds) const;

    std::mutex mutex_;
    std::string title_;
    std::size_t total_;
    std::size_t done_ = 0;
    std::size_t shown_tenth_ = 0;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
};

}  // namespace base
