// A model that is simulated over a log steps at its own rate: the log's input on those steps, and the output back at
// the log's own stamps, so that the two can be compared sample by sample.
#pragma once

#include "drive/log.hpp"

namespace drive {

/// The log in time from 0.
[[nodiscard]] Log from_start(Log log);

/// The log on steps of `step_s`, in time from 0 to the first that is not before its last stamp; every column held.
/// \throws glsum::Failure (bad input) as `resample`
[[nodiscard]] Log on_steps(const Log& log, double step_s);

/// The log with the output of `simulated`, which `on_steps` of it became: at the log's stamps, linear between two
/// steps.
[[nodiscard]] Log at_own_stamps(Log log, const Log& simulated);

}  // namespace drive
