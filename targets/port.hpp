// The port contract: what a board gives to the firmware programs. Everything else they need is in kernels/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace port {

/// Called first of all, before data is copied: clocks, caches, memories that are filled by software.
void start();

/// The words that the program was started with, its own name first, separated by single spaces.
std::string_view command_line();
/// Writes to the log that the host reads.
void write(std::string_view text);
/// Reads a whole file of the host's into the buffer.
/// \return its bytes; empty when it cannot be opened or does not fit.
std::span<std::byte> read_file(std::string_view path, std::span<std::byte> buffer);
/// Ends the program; 0 is success.
[[noreturn]] void exit(int status);

/// The core's cycle counter, which wraps; 0, always, on a board without one.
std::uint32_t cycles();

/// Where kernels and their data lie, in the words of a file of measured cycles.
struct Memories {
    std::string_view code;   ///< flash_cached, flash or itcm
    std::string_view data;   ///< dtcm or axi
    bool maintenance;        ///< whether each call's timing is to hold a clean and invalidate of the data cache
    std::string_view setup;  ///< what else a measurement depends on, in one word
    std::uintptr_t code_end = UINTPTR_MAX;  ///< functions from here on lie elsewhere than in `code`
};
Memories memories();
/// Cleans and invalidates the whole data cache.
void maintain_data_cache();

}  // namespace port

/// The program (one of firmware/), called by the start-up code with the FPU on, data copied and bss cleared. Its result
/// is the exit status. Of C linkage, so that C programs have it too.
extern "C" int firmware_main();
