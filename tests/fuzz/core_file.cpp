// A core file from anywhere, alone and as the base of another.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "qemu/timing/core_file.hpp"
#include "tests/fuzz/refused.hpp"

namespace {

// The reader takes a folder: one in memory, gone with the process.
struct Folder {
    std::filesystem::path path;
    Folder()
        : path((std::filesystem::exists("/dev/shm") ? "/dev/shm" : "/tmp") +
               ("/glsum-fuzz-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path);
        std::ofstream(path / "based.toml") << "base = \"core\"\n";
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Folder folder;
    std::ofstream(folder.path / "core.toml", std::ios::binary) << fuzz::to_text(data, size);
    for (const char* name : {"core", "based"}) {
        fuzz::refused_or([&] {
            const timing::CoreFile core = timing::read_core(folder.path, name);
            fuzz::expect(!core.sets.empty() && core.sets.front().name == "nominal");
        });
    }
    return 0;
}
