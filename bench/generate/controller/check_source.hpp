// C code that steps generated controllers over a record, and what their outputs are to be.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/generate/controller/stepped.hpp"
#include "targets/shared/timed_calls.hpp"

namespace generate {

/// A header as it was written.
struct WrittenController {
    std::string prefix;
    std::string text;
    ControllerSpec spec;
};

/// Set points and readings, of equal length.
struct CheckRecord {
    std::vector<float> setpoint;
    std::vector<float> measured;
};

/// 4000 samples: steps of the set point, a reading that follows late and noisily; the last quarter is a hundred times
/// as large, so that limits are met.
[[nodiscard]] CheckRecord check_record();

/// C99 that includes each `<prefix>.h` and has, in their order, `entries[]`. An entry steps its
/// controller over the record and returns 1 and the index of the first output whose bits are not the library's; behind
/// the record it runs the header's self-check. 0: all are.
[[nodiscard]] std::string check_source(const std::vector<WrittenController>& controllers);

/// The same as a part of targets/firmware/verify.cpp: a function count_<prefix> of one step to be counted, and the
/// calls of it behind each check. Tables lie in RAM, as a kernel's do.
[[nodiscard]] std::string target_source(const std::vector<WrittenController>& controllers);

inline constexpr std::size_t answers_a_controller = 3;

/// The calls that it makes: the states have settled behind the first of them.
inline constexpr firmware::TimedCalls controller_calls{32, false};

/// What an entry returns where the self-check alone fails.
inline constexpr std::uint32_t self_check_failed = 0xFFFFFFFF;

}  // namespace generate
