// A script in the place of a board's emulator: it keeps what it was told, and hands over logs that were made by hand.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "base/scratch.hpp"
#include "qemu/emulate/emulator.hpp"

namespace test {

/// Runs `body` in the folder; there "$(of NAME)" is what the plugin's argument NAME= says.
inline qemu::Emulator made_emulator(const base::Scratch& folder, const std::string& body) {
    const std::filesystem::path path = folder.file("emulate");
    std::ofstream(path) << "#!/bin/sh\nof() { echo \"$GLSUM_QEMU_PLUGIN\" | tr , '\\n' | sed -n \"s/^$1=//p\"; }\ncd '"
                        << folder.file("").string() << "'\n"
                        << body;
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return {.command = path};
}

}  // namespace test
