// Dot products of other libraries, fed in the way that suits them best: a doubled buffer, so that the window is always
// contiguous. Its upkeep is inside the timing, as it is for our kernels.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace bench {

/// One library's dot product with a fixed set of coefficients.
class PeerDot {
public:
    virtual ~PeerDot() = default;
    /// sum_j coefficients[j] window[j], window newest first
    virtual float dot(const float* window) = 0;
};

struct Peer {
    std::string_view name;  ///< "peer_<library>_f32"
    std::unique_ptr<PeerDot> (*make)(const std::vector<float>& coefficients);
};

/// The peers that were found when this was built, in a fixed order.
[[nodiscard]] const std::vector<Peer>& peers();

/// A peer's dot product over its sliding window.
class PeerLine {
public:
    /// \param skipped  samples before the window, which place it in memory
    PeerLine(const Peer& peer, const std::vector<float>& coefficients, std::size_t skipped = 0)
        : taps_(coefficients.size()),
          memory_(skipped + 2 * taps_, 0.0F),
          window_(memory_.data() + skipped),
          dot_(peer.make(coefficients)) {}
    PeerLine(const PeerLine&) = delete;
    PeerLine& operator=(const PeerLine&) = delete;

    float step(float newest) {
        head_ = (head_ == 0 ? taps_ : head_) - 1;
        window_[head_] = window_[head_ + taps_] = newest;
        return dot_->dot(window_ + head_);
    }

private:
    std::size_t taps_;
    std::size_t head_ = 0;
    std::vector<float> memory_;
    float* window_;
    std::unique_ptr<PeerDot> dot_;
};

}  // namespace bench
