// C code that steps generated headers over a record, and what their outputs are to be.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "targets/shared/timed_calls.hpp"

namespace generate {

/// A header of a controller or a model as it was written, and what holds it to the library.
struct WrittenStepper {
    std::string prefix;
    std::string text;
    std::string format;                              ///< f32 or q31: ends its names
    std::vector<std::vector<std::uint32_t>> inputs;  ///< bits, of each argument of its step, of equal length
    std::vector<std::uint32_t> expected;             ///< bits of the library's outputs, as many
    std::vector<std::string> tables;                 ///< words between prefix and format; those that it has
};

/// C99 that includes each `<prefix>.h` and has, in their order, `entries[]`. An entry steps its header over the record
/// and returns 1 and the index of the first output whose bits are not the library's; behind the record it runs the
/// header's self-check. 0: all are.
[[nodiscard]] std::string check_source(const std::vector<WrittenStepper>& steppers);

/// The same as a part of targets/firmware/verify.cpp: a function count_<prefix> of one step to be counted, and the
/// calls of it behind each check. Tables lie in RAM, as a kernel's do.
[[nodiscard]] std::string target_source(const std::vector<WrittenStepper>& steppers);

inline constexpr std::size_t answers_a_stepper = 3;

/// The calls that it makes: the states have settled behind the first of them.
inline constexpr firmware::TimedCalls stepper_calls{32, false};

/// What an entry returns where the self-check alone fails.
inline constexpr std::uint32_t self_check_failed = 0xFFFFFFFF;

}  // namespace generate
