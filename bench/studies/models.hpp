// Whole models stepped in real time at 1 kHz, on this machine and on an emulated one.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/studies/study.hpp"
#include "drive/realtime.hpp"
#include "qemu/emulate/firmware.hpp"

namespace bench {

/// What a kernel is asked for: nothing is full memory.
using ModelLengths = std::vector<std::optional<drive::Memory>>;

constexpr std::size_t model_response_steps = 5000;  ///< 5 s behind the dead time

/// An emulated machine that steps them.
struct ModelBoard {
    qemu::Board board;
    std::vector<std::string> cores;  ///< of the timing model, the machine's; the first is what the table shows
};

struct Models {
    std::vector<std::string> kernels{"*"};  ///< globs
    ModelLengths lengths;                   ///< empty: the usual ones
    std::vector<std::string> targets{"host", "m7"};
    bool quick = false;  ///< fewer lengths, and no long records
    std::vector<std::size_t> long_records{model_response_steps, 100'000,
                                          1'000'000};  ///< samples, by blocks; two or more, rising
    unsigned jobs = 1;
    std::filesystem::path models;         ///< the folder of fopdt.json, sopdt.json and niopdt.json
    std::vector<ModelBoard> boards = {};  ///< of the emulated machines among the targets
};

/// Rows `drive/<model>/<kernel>/taps:<L>/<target>`. \param say  told of what is left out, and why
/// \throws glsum::Failure (bad input): nothing that can be stepped
[[nodiscard]] Study measure_models(const Models& wanted, const std::function<void(const std::string&)>& say);

}  // namespace bench
