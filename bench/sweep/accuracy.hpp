// Accuracy of every kernel against the reference.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/rows/row.hpp"
#include "bench/sweep/sweep.hpp"

namespace bench {

/// One row for each kernel (but `null`), order, length and signal. Errors are of S_k, before h^-v, relative to
/// max_k |E_k| of the exact full-memory sum E of the sweep's weights:
///   error_max, error_rms                            kernel against E
///   rounding_error_max                              kernel against the exact sum of what its design stands for:
///                                                   of its taps; of its taps and exponentials, as designed in double;
///                                                   of its taps and blocks; of the increments kept; of its taps and
///                                                   the tail that it guesses
///   truncation_error_max                            that sum against E
///   discretisation_error_max                        E against h^v / w_0 D^v x(t_k - lag), the exact derivative
///                                                   (discretisation.hpp), at up to 200 k log-spaced over 1..N-1; of
///                                                   the order and the signal, whatever the kernel and the length; none
///                                                   for signals without a formula
///   discretisation_error_late_max                   the same of the record's second half, at about 16 k: what is left
///                                                   when the start of the signal has faded
///   derivative_error_max, derivative_error_late_max  kernel against that derivative, at the same k
/// `horizon_samples`: how far back the sum sees; of a design with modes, for how far its error holds.
/// At 600 taps of a window the signals sine5 and drive are repeated at 2^-4 and 2^-8 of their size, named
/// ".../signal:<s>/amplitude:<a>"; their errors are relative to their own, smaller, sums.
/// \param cases  which pairs of order and signal: order * signals + signal
/// \return  the rows of each case
[[nodiscard]] std::vector<std::vector<Json>> measure_accuracy(const Sweep& sweep,
                                                              const std::vector<std::size_t>& cases);

}  // namespace bench
