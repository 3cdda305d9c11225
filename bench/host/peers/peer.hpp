// Dot products of other libraries, fed in the way that suits them best: a doubled buffer, so that the window is always
// contiguous. Its upkeep is inside the timing, as it is for our kernels.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace bench {

/// One library's dot product with a fixed set of coefficients.
template <class SampleType, class SumType>
class PeerDot {
public:
    using Sample = SampleType;
    using Sum = SumType;
    virtual ~PeerDot() = default;
    /// sum_j coefficients[j] window[j], window newest first
    virtual Sum dot(const Sample* window) = 0;
};

using F32Dot = PeerDot<float, float>;
using Q31Dot = PeerDot<std::int32_t, std::int64_t>;
/// Coefficients of a q31 peer have so many fraction bits, where |a_j| stays below 4 and a sum within 64 bits; else
/// fewer.
inline constexpr int q31_coefficient_bits = 29;

template <class Dot>
using MakeDot = std::unique_ptr<Dot> (*)(const std::vector<typename Dot::Sample>& coefficients);

struct Peer {
    std::string_view name;  ///< "peer_<library>_<format>"
    std::variant<MakeDot<F32Dot>, MakeDot<Q31Dot>> make;
};

/// The peers that were found when this was built, in a fixed order.
[[nodiscard]] const std::vector<Peer>& peers();

/// A peer's dot product over its sliding window.
template <class Dot>
class PeerLine {
public:
    using Sample = typename Dot::Sample;
    /// \param skipped  samples before the window, which place it in memory
    PeerLine(MakeDot<Dot> make, const std::vector<Sample>& coefficients, std::size_t skipped = 0)
        : taps_(coefficients.size()),
          memory_(skipped + 2 * taps_, Sample{}),
          window_(memory_.data() + skipped),
          dot_(make(coefficients)) {}
    PeerLine(const PeerLine&) = delete;
    PeerLine& operator=(const PeerLine&) = delete;

    typename Dot::Sum step(Sample newest) {
        head_ = (head_ == 0 ? taps_ : head_) - 1;
        window_[head_] = window_[head_ + taps_] = newest;
        return dot_->dot(window_ + head_);
    }

private:
    std::size_t taps_;
    std::size_t head_ = 0;
    std::vector<Sample> memory_;
    Sample* window_;
    std::unique_ptr<Dot> dot_;
};

}  // namespace bench
