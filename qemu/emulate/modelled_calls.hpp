// What the timing model says of the calls that a firmware program marked, put together for one row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "qemu/timing/timing_log.hpp"
#include "targets/shared/timed_calls.hpp"

namespace qemu {

/// What one core takes for a call, in modelled cycles: see targets/shared/timed_calls.hpp for the calls.
struct ModelledCall {
    double cycles;  ///< the mean of the steady calls, with the nominal rules
    double low;     ///< over the core file's rule sets, the nominal one included
    double high;
    double first_cycles;                            ///< of the call after `prepare`, caches and branch predictor cold
    double worst_cycles;                            ///< of the timed calls once the past is full
    double latency_cycles;                          ///< from sample to result: of the first half, else `cycles`
    std::array<double, timing::effect_count> lost;  ///< of `cycles`, to each effect
    double double_in_software = 0.0;  ///< of `cycles`, within the routines that compute in double precision
    bool operator==(const ModelledCall&) const = default;
};

/// One for each of `cores`. \param first_instructions  what the counter saw of the first call \param what  names the
/// row in an error \param answers  how many first halves were marked behind the calls \throws glsum::Failure when the
/// log holds other calls than were marked
[[nodiscard]] std::vector<ModelledCall> modelled_calls(const timing::TimingLog& log, const firmware::TimedCalls& timed,
                                                       std::size_t calls, std::size_t cores,
                                                       std::uint64_t first_instructions, const std::string& what,
                                                       std::size_t answers = 0);

}  // namespace qemu
