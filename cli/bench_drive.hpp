// bench --drive: whole models stepped in real time, on this machine and on the emulated Cortex-M7.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cli {

struct DriveBench {
    std::vector<std::string> kernels;  ///< globs
    std::vector<std::string> taps;     ///< numbers, full, or 2+7 of kernels with modes; empty: the usual ones
    std::vector<std::string> targets;
    std::vector<std::string> cores;  ///< of the timing model; the first is what the table shows
    bool quick = false;
    unsigned jobs = 1;
    std::filesystem::path out;
};

/// Measures and prints, and writes rows `drive/<model>/<kernel>/taps:<L>/<target>`.
void run_drive_bench(const DriveBench& options);

}  // namespace cli
