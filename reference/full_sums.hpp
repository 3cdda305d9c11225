// Full memory over a long record: its sums are the digits of one product of two large integers [Kronecker1882], for
// which GMP has a fast Fourier transform. What `sums` finds by definition in n^2 / 2 products takes n log n here.
#pragma once

#include <span>

#include "reference/sums.hpp"

namespace reference {

/// S_k of full memory for all k of a record: of one with 20 000 samples in a second.
/// \param a       weights in 50 digits, at least as many as the record has samples; below 2^64
/// \param record  below 2^64
/// Error: at most 2^-158 n max(|a|, |x|) in exact numbers, before they are rounded to 106 bits.
[[nodiscard]] Sums full_sums(std::span<const Real> a, std::span<const double> record);

}  // namespace reference
