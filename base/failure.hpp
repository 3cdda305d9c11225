// What the tools throw: a message for the user and the exit status that it ends the command with.
#pragma once

#include <stdexcept>
#include <string>

namespace glsum {

enum class Exit : int {
    good = 0,
    check_failed = 1,
    bad_input = 2,
    missing = 3,
    not_comparable = 4,
};

class Failure : public std::runtime_error {
public:
    Failure(Exit status, const std::string& message) : std::runtime_error(message), status_(status) {}
    [[nodiscard]] Exit status() const { return status_; }

private:
    Exit status_;
};

}  // namespace glsum
