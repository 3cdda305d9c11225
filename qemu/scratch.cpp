#include "qemu/scratch.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "qemu/failure.hpp"

namespace qemu {

Scratch::Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "glsum-XXXXXX").string();
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

}  // namespace qemu
