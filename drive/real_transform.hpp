// The discrete Fourier transform of real numbers, by FFTW in double.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace drive {

/// Transforms of one length, in place, forward and back. Planned by FFTW's estimate, never by timing: the same machine
/// gives the same bits in every run. The functions of one object may run in several threads at once.
class RealTransform {
public:
    /// Room for so many reals, or, in the same place, for their half spectrum of length/2 + 1 values.
    class Buffer {
    public:
        /// So many reals: at first those of `first`, at most `length`, then zeros. \throws std::bad_alloc
        explicit Buffer(std::size_t length, std::span<const double> first = {});
        [[nodiscard]] std::span<double> reals() { return {data_.get(), length_}; }
        [[nodiscard]] std::span<const double> reals() const { return {data_.get(), length_}; }
        [[nodiscard]] std::span<std::complex<double>> spectrum();
        [[nodiscard]] std::span<const std::complex<double>> spectrum() const;

    private:
        struct Release {
            void operator()(double* data) const;
        };
        std::size_t length_;
        std::unique_ptr<double, Release> data_;
    };

    /// The transform of a length of 1 to 2^30. Planned at its first use and kept until the process ends, since planning
    /// takes longer than transforming. \throws std::invalid_argument for another length
    [[nodiscard]] static const RealTransform& of(std::size_t length);
    /// The least length of at least `count` that is fast here: 16 times a product of factors 2, 3 and 5.
    [[nodiscard]] static std::size_t fast_length(std::size_t count);

    RealTransform(const RealTransform&) = delete;
    RealTransform& operator=(const RealTransform&) = delete;
    ~RealTransform();

    /// X_m = sum_n x_n exp(-2 pi i m n / length), m = 0 ... length/2. \param buffer  of this length
    void forward(Buffer& buffer) const;
    /// Spectra of two records in, the cyclic convolution of the two out, as reals in `one`. Both of this length.
    void convolve(Buffer& one, const Buffer& other) const;

private:
    struct Plans;
    explicit RealTransform(std::size_t length);

    std::size_t length_;
    std::unique_ptr<Plans> plans_;
};

}  // namespace drive
