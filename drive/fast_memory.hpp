// The sum of a whole past by blocks: what full memory costs when it must be affordable for long records.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "drive/real_transform.hpp"

namespace drive {

/// Evaluates H_k = sum_{j=1..k} w_j y_(k-j) sample by sample, where y_k may depend on H_k.
///
/// The last 255 samples are summed directly, oldest first; older ones come in blocks of 256, 512, 1024, ... samples,
/// each convolved once, by FFT, into the future that it will be needed in (Hairer, Lubich and Schlichte, SIAM J. Sci.
/// Stat. Comput. 6, 1985). N samples cost O(N log^2 N). The large first weights never pass through an FFT, so that its
/// rounding is relative to the tail of the weights: about 1e-16 of sum_{j>=256} |w_j| max|y|.
class FastMemory {
public:
    /// \param weights  w_0 (not used), w_1, ...: as many as samples will come; what lies beyond counts as 0
    explicit FastMemory(std::span<const double> weights);

    /// H_k for the next sample k = 0, 1, ...
    [[nodiscard]] double past() const;
    /// y_k: the next sample.
    void push(double sample);

private:
    void spread_block(std::size_t size);

    std::vector<double> weights_;
    std::vector<double> samples_;
    std::vector<double> future_;  // what the blocks add to H_k, for k from the last block's end on
    std::size_t count_ = 0;
    std::map<std::size_t, RealTransform::Buffer> spectra_;  // of the weights direct .. 2 size - 1, by size
};

}  // namespace drive
