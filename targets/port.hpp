// The port contract: what a board gives to the firmware programs. Everything else they need is in kernels/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace port {

/// The words that the program was started with, its own name first, separated by single spaces.
std::string_view command_line();
/// Writes to the log that the host reads.
void write(std::string_view text);
/// Reads a whole file of the host's into the buffer.
/// \return its bytes; empty when it cannot be opened or does not fit.
std::span<std::byte> read_file(std::string_view path, std::span<std::byte> buffer);
/// Ends the program; 0 is success.
[[noreturn]] void exit(int status);

}  // namespace port

/// The program (one of firmware/), called by the start-up code with the FPU on, data copied and bss cleared. Its result
/// is the exit status.
int firmware_main();
