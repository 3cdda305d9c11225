// A plain convolution of two whole records by FFTW: what one costs anyone who has the library.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace bench {

/// Two real transforms forward, a product, one back, all in place. For one thread; nothing else may plan meanwhile.
class FftwConvolution {
public:
    enum class Planning {
        estimate,  ///< by FFTW's rules of thumb, without timing
        measure    ///< by timing
    };

    /// Plans. \param length  of the transforms; at least `samples`, and twice that less one for sums without what comes
    /// round from the end
    /// \param longest_s  seconds that timing may take each way, above 0
    /// \throws std::invalid_argument where the length does not suffice, or is beyond 2^30
    FftwConvolution(std::size_t samples, std::size_t length, Planning planning, double longest_s);
    FftwConvolution(const FftwConvolution&) = delete;
    FftwConvolution& operator=(const FftwConvolution&) = delete;
    ~FftwConvolution();

    /// Puts two records of `samples` in place, zeros behind them.
    void load(std::span<const double> one, std::span<const double> other);
    /// Convolves what was loaded, and overwrites it: once a load. The first `samples` results, not divided by the
    /// length.
    std::span<const double> run();

    [[nodiscard]] static std::string version();

private:
    struct Parts;
    std::size_t samples_;
    std::size_t length_;
    std::unique_ptr<Parts> parts_;
};

}  // namespace bench
