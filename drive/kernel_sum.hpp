// A kernel as an implicit scheme needs it: first the sum of the past alone, then the sample that solves the equation.
#pragma once

#include <algorithm>
#include <boost/align/aligned_allocator.hpp>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "glsum/kernel.hpp"

namespace drive {

/// What a scheme asks of a kernel's sum, whatever its type.
class PastSum {
public:
    virtual ~PastSum() = default;
    [[nodiscard]] virtual glsum::Status status() const = 0;
    /// sum_{j>=1} a_j x_(k-j), before h^-v.
    virtual double past() = 0;
    /// x_k; the sum of order v over it is not looked at.
    virtual void push(double sample) = 0;
    /// Samples beyond full scale, and sums that saturated.
    [[nodiscard]] virtual std::size_t saturations() const = 0;
};

/// A kernel sums and stores in one step, and a_0 = 1 with no multiplication: its sum for a sample of 0 is that of the
/// past. The state is kept, tried with 0, put back, and stepped with the sample, so that any kernel serves unchanged.
template <class K>
class KernelSum final : public PastSum {
public:
    explicit KernelSum(const glsum::Design& design)
        : table_(K::table_count(design.taps) + 1), past_(K::past_count(design.taps) + 1), kept_(past_.size()) {
        status_ = K::prepare(state_, design, table_, past_);
    }

    [[nodiscard]] glsum::Status status() const override { return status_; }

    double past() override {
        const auto state = state_;
        std::copy(past_.begin(), past_.end(), kept_.begin());
        const double sum = K::to_real(state_, K::step(state_, K::from_real(0.0)));
        state_ = state;
        std::copy(kept_.begin(), kept_.end(), past_.begin());
        return sum;
    }

    void push(double sample) override {
        if constexpr (!std::is_floating_point_v<typename K::Sample>) {
            clipped_ += sample >= 1.0 || sample < -1.0 ? 1 : 0;
        }
        (void)K::step(state_, K::from_real(sample));
    }

    [[nodiscard]] std::size_t saturations() const override {
        if constexpr (requires { state_.scale.saturations; }) {
            return clipped_ + state_.scale.saturations;
        }
        return clipped_;
    }

private:
    // At the start of a cache line, as vector kernels want it; never empty.
    template <class T>
    using Buffer = std::vector<T, boost::alignment::aligned_allocator<T, 64>>;

    Buffer<typename K::Coefficient> table_;
    Buffer<typename K::Sample> past_;
    Buffer<typename K::Sample> kept_;
    typename K::State state_{};
    glsum::Status status_ = glsum::Status::ok;
    std::size_t clipped_ = 0;
};

}  // namespace drive
