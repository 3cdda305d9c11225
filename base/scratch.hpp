// A folder for the files of one run, removed with the object.
#pragma once

#include <filesystem>

namespace base {

class Scratch {
public:
    /// \throws glsum::Failure when no folder can be made.
    Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch();
    [[nodiscard]] std::filesystem::path file(const char* name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

}  // namespace base
