#include "drive/fast_memory.hpp"

#include <algorithm>
#include <map>
#include <unsupported/Eigen/FFT>

namespace drive {
namespace {

constexpr std::size_t direct = 256;  // weights below this are never in a transform

using Spectrum = std::vector<std::complex<double>>;

}  // namespace

struct FastMemory::Transforms {
    Eigen::FFT<double> fft;
    std::map<std::size_t, Spectrum> weights;  // of the weights direct .. 2 size - 1, by size
};

FastMemory::FastMemory(std::span<const double> weights)
    : weights_(weights.begin(), weights.end()),
      samples_(weights.size()),
      future_(weights.size() + 1, 0.0),
      transforms_(std::make_unique<Transforms>()) {
    transforms_->fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
}

FastMemory::~FastMemory() = default;

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
    auto [found, fresh] = transforms_->weights.try_emplace(size);
    if (fresh) {
        std::vector<double> head(2 * size, 0.0);
        std::copy_n(weights_.begin(), std::min(2 * size, weights_.size()), head.begin());
        std::fill_n(head.begin(), direct, 0.0);
        transforms_->fft.fwd(found->second, head);
    }
    std::vector<double> block(2 * size, 0.0);
    std::copy_n(samples_.begin() + static_cast<std::ptrdiff_t>(count_ - size), size, block.begin());
    Spectrum spectrum;
    transforms_->fft.fwd(spectrum, block);
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
        spectrum[i] *= found->second[i];
    }
    std::vector<double> product(2 * size);
    transforms_->fft.inv(product, spectrum, static_cast<Eigen::Index>(2 * size));
    const std::size_t outputs = std::min(size, future_.size() - count_);
    for (std::size_t i = 0; i < outputs; ++i) {
        future_[count_ + i] += product[size + i];
    }
}

}  // namespace drive
