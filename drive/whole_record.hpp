// The sums over a whole past of a record that is known from its first to its last sample: full memory at the price of
// one convolution by FFT.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace drive {

/// S_k = sum_{j=0..k} w_j x_(k-j) for every sample k of a record, in O(N log N).
///
/// The first 16 weights, which are the large ones, never pass through a transform: their products are summed directly,
/// oldest first, on top of what the FFT makes of the others. The rounding of the transforms is thus relative to the
/// tail of the weights: over 100 000 samples of 1 at order 1.9909 the errors stay below 5e-16, where a transform of
/// everything leaves 2e-15. Below order 0 the tail is most of the sum, and nothing is gained.
///
/// Where a sample depends on the sums before it, as in a model that is stepped, `FastMemory` is what helps.
///
/// \param weights  w_0, w_1, ...; those beyond the record are not used, missing ones count as 0. For a sum of the order
///                 v, the a_j of `glsum::Weights`
/// \param record   x_0, x_1, ...: finite numbers, up to 5 10^8 of them
/// \return         as many sums as the record has samples. Each is within `whole_record_error_bound` of the exact sum
///                 of the given numbers; relative to the largest sample, not to those before k: behind a peak of 1 an
///                 earlier sum of 1e-16 is noise
/// \throws glsum::Failure (bad input) for a weight or sample that is not finite; std::invalid_argument for a longer
/// record
[[nodiscard]] std::vector<double> whole_record_sums(std::span<const double> weights, std::span<const double> record);

/// a_0 ... a_(count-1) of an order, as `glsum::Weights` gives them: they make the sums those of the order.
[[nodiscard]] std::vector<double> record_weights(double order, std::size_t count);

/// How far each sum can be from the exact one of the given numbers, u being 2^-53:
///
///   u [ sum_{j<16} (j + 2) |w_j| max|x|  +  17 min(|w_far|_1 max|x|, |w_far|_2 |x|_2)  +  log2(M) |w_far|_2 |x|_2 ]
///
/// with w_far the weights from w_16 on and M the length of the transform; up to 128 weights, where no transform is
/// faster, the first part runs over all of them and is the whole. The first two parts are the most that rounding can do
/// in the products and additions; the third allows for the transforms, whose errors grow as the root of log2(M)
/// (Schatzman, SIAM J. Sci. Comput. 17, 1996): the tests find errors of half the bound at most.
[[nodiscard]] double whole_record_error_bound(std::span<const double> weights, std::span<const double> record);

}  // namespace drive
