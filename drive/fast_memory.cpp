#include "drive/fast_memory.hpp"

#include <algorithm>

namespace drive {
namespace {

constexpr std::size_t direct = 256;  // weights below this are never in a transform

}  // namespace

FastMemory::FastMemory(std::span<const double> weights)
    : weights_(weights.begin(), weights.end()), samples_(weights.size()), future_(weights.size() + 1, 0.0) {}

double FastMemory::past() const {
    double sum = future_[count_];
    for (std::size_t i = count_ - std::min(count_, direct - 1); i < count_; ++i) {
        sum += weights_[count_ - i] * samples_[i];
    }
    return sum;
}

void FastMemory::push(double sample) {
    samples_[count_++] = sample;
    if (count_ % direct != 0 || count_ == weights_.size()) {
        return;
    }
    // The block ends here whose size is the largest power of two, times `direct`, that divides the count. It serves the
    // next `size` outputs; behind them a larger block will hold its samples.
    spread_block(direct * ((count_ / direct) & ~(count_ / direct - 1)));
}

void FastMemory::spread_block(std::size_t size) {
    const RealTransform& transform = RealTransform::of(2 * size);
    auto [found, fresh] = spectra_.try_emplace(size, 2 * size);
    if (fresh) {
        const std::span<double> head = found->second.reals();
        std::copy(weights_.begin() + direct,
                  weights_.begin() + static_cast<std::ptrdiff_t>(std::min(2 * size, weights_.size())),
                  head.begin() + direct);
        transform.forward(found->second);
    }
    RealTransform::Buffer block(2 * size, std::span(samples_).subspan(count_ - size, size));
    transform.forward(block);
    transform.convolve(block, found->second);
    const std::size_t outputs = std::min(size, future_.size() - count_);
    for (std::size_t i = 0; i < outputs; ++i) {
        future_[count_ + i] += block.reals()[size + i];
    }
}

}  // namespace drive
