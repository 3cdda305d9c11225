// The weights of a design's blocks (logmemory/nested.hpp), from those of its lags.
#pragma once

#include <cstddef>

#include "glsum/kernel.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// Walks the blocks, newest first, with a walk over the weights that stands at the last near tap.
/// The sum of a block's weights is carried with what its additions lost: right to the last bit or two where they have
/// one sign, however many they are, in the same bits on every machine.
class BlockWeights {
public:
    BlockWeights(const Blocks& blocks, Weights& weights) : weights_(weights), blocks_(blocks) {}

    void next() {
        if (in_level_ == blocks_.per_level || level_ == 0) {
            ++level_;
            width_ *= 2;
            in_level_ = 0;
        }
        ++in_level_;
        double high = 0.0;
        double low = 0.0;
        absolute_ = 0.0;
        for (std::size_t i = 0; i < width_; ++i) {
            weights_.next();
            const double weight = weights_.weight();
            const double next = high + weight;
            const double part = next - high;
            low += (high - (next - part)) + (weight - part);
            high = next;
            absolute_ += weight < 0.0 ? -weight : weight;
        }
        sum_ = high + low;
    }
    /// l: the block is of 2^l lags.
    [[nodiscard]] std::size_t level() const { return level_; }
    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] double sum() const { return sum_; }
    /// Of the weights' magnitudes.
    [[nodiscard]] double absolute() const { return absolute_; }
    /// A power of two: exact.
    [[nodiscard]] double mean() const { return sum_ / static_cast<double>(width_); }

private:
    Weights& weights_;
    Blocks blocks_;
    std::size_t level_ = 0;
    std::size_t width_ = 1;
    std::size_t in_level_ = 0;
    double sum_ = 0.0;
    double absolute_ = 0.0;
};

}  // namespace glsum
