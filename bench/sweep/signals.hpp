// The records that accuracy is measured on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bench {

inline constexpr double step_s = 1e-3;      ///< h of every record
inline constexpr double signal_peak = 0.9;  ///< of full scale
inline constexpr std::string_view signal_names[] = {"step", "ramp", "sine1", "sine5", "sine50", "noise", "drive"};

/// In a sentence, of one of these. \throws std::out_of_range for another name.
[[nodiscard]] std::string_view meaning_of_signal(std::string_view name);

/// The frequency of the signals `sine<f>`, in Hz; nothing for all others.
[[nodiscard]] std::optional<double> sine_hz(std::string_view name);

/// A record of a signal, with its largest magnitude at or just below 0.9:
///   step    0.9 from k = 0;  ramp  from 0 to 0.9 at the last sample;  sine<f>  0.9 sin(2 pi f k h)
///   noise   white, uniform on [-0.9, 0.9), the same on every machine for the same seed
///   drive   the step response of [Matusiak2020] (12) without its delay, quantised to 1000 counts a turn with 45
///           degrees as 1, then scaled to 0.9
/// \param h_s  seconds from sample to sample, above 0. Another one than 1 ms samples the same sines and the same step
///             response elsewhere; step, ramp and noise, which have no time of their own, stay what they are.
/// \throws std::out_of_range for another name.
[[nodiscard]] std::vector<double> make_signal(std::string_view name, std::size_t samples, std::uint64_t seed,
                                              double h_s = step_s);

/// Whether samples at this distance can show the signal: a sine needs more than two a period.
[[nodiscard]] bool can_be_sampled(std::string_view name, double h_s);

}  // namespace bench
