#include "drive/real_transform.hpp"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <new>
#include <stdexcept>

namespace drive {
namespace {

constexpr std::size_t longest = std::size_t{1} << 30;  // FFTW counts in int

// FFTW plans in one thread at a time; carrying plans out needs no lock.
std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
}

fftw_complex* as_fftw(RealTransform::Buffer& buffer) {
    return reinterpret_cast<fftw_complex*>(buffer.spectrum().data());
}

}  // namespace

struct RealTransform::Plans {
    fftw_plan forward = nullptr;
    fftw_plan back = nullptr;
};

RealTransform::Buffer::Buffer(std::size_t length, std::span<const double> first)
    : length_(length), data_(fftw_alloc_real(2 * (length / 2 + 1))) {
    if (!data_) {
        throw std::bad_alloc();
    }
    std::fill(std::copy(first.begin(), first.end(), data_.get()), data_.get() + 2 * (length / 2 + 1), 0.0);
}

void RealTransform::Buffer::Release::operator()(double* data) const { fftw_free(data); }

// The standard lays a complex number out as its two reals.
std::span<std::complex<double>> RealTransform::Buffer::spectrum() {
    return {reinterpret_cast<std::complex<double>*>(data_.get()), length_ / 2 + 1};
}

std::span<const std::complex<double>> RealTransform::Buffer::spectrum() const {
    return {reinterpret_cast<const std::complex<double>*>(data_.get()), length_ / 2 + 1};
}

const RealTransform& RealTransform::of(std::size_t length) {
    static std::map<std::size_t, std::unique_ptr<RealTransform>> known;
    const std::scoped_lock lock(planner());
    auto& transform = known[length];
    if (!transform) {
        transform.reset(new RealTransform(length));
    }
    return *transform;
}

std::size_t RealTransform::fast_length(std::size_t count) {
    std::size_t least = 0;
    for (std::size_t fives = 16; least == 0 || fives < least; fives *= 5) {
        for (std::size_t odd = fives; least == 0 || odd < least; odd *= 3) {
            std::size_t length = odd;
            while (length < count) {
                length *= 2;
            }
            least = least == 0 ? length : std::min(least, length);
        }
    }
    return least;
}

RealTransform::RealTransform(std::size_t length) : length_(length), plans_(std::make_unique<Plans>()) {
    if (length == 0 || length > longest) {
        throw std::invalid_argument(fmt::format("expected a length of 1 to {}, found {}", longest, length));
    }
    Buffer buffer(length);
    const auto count = static_cast<int>(length);
    plans_->forward = fftw_plan_dft_r2c_1d(count, buffer.reals().data(), as_fftw(buffer), FFTW_ESTIMATE);
    plans_->back = fftw_plan_dft_c2r_1d(count, as_fftw(buffer), buffer.reals().data(), FFTW_ESTIMATE);
}

RealTransform::~RealTransform() {
    fftw_destroy_plan(plans_->forward);
    fftw_destroy_plan(plans_->back);
}

void RealTransform::forward(Buffer& buffer) const {
    fftw_execute_dft_r2c(plans_->forward, buffer.reals().data(), as_fftw(buffer));
}

void RealTransform::convolve(Buffer& one, const Buffer& other) const {
    const std::span<std::complex<double>> a = one.spectrum();
    const std::span<const std::complex<double>> b = other.spectrum();
    const double share = 1.0 / static_cast<double>(length_);
    // Written out: the operator of std::complex looks for infinities, which takes longer than the product.
    for (std::size_t m = 0; m < a.size(); ++m) {
        a[m] = {share * (a[m].real() * b[m].real() - a[m].imag() * b[m].imag()),
                share * (a[m].real() * b[m].imag() + a[m].imag() * b[m].real())};
    }
    fftw_execute_dft_c2r(plans_->back, as_fftw(one), one.reals().data());
}

}  // namespace drive
