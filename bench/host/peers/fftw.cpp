#include "bench/host/peers/fftw.hpp"

#include <fftw3.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace bench {
namespace {

constexpr std::size_t longest = std::size_t{1} << 30;

struct Release {
    void operator()(double* data) const { fftw_free(data); }
};
using Reals = std::unique_ptr<double, Release>;

Reals make_reals(std::size_t length) {
    Reals reals(fftw_alloc_real(2 * (length / 2 + 1)));
    if (!reals) {
        throw std::bad_alloc();
    }
    return reals;
}

fftw_complex* spectrum(const Reals& reals) { return reinterpret_cast<fftw_complex*>(reals.get()); }

void fill(const Reals& reals, std::size_t length, std::span<const double> record) {
    std::fill(std::copy(record.begin(), record.end(), reals.get()), reals.get() + length, 0.0);
}

}  // namespace

struct FftwConvolution::Parts {
    explicit Parts(std::size_t length) : one(make_reals(length)), other(make_reals(length)) {}
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    ~Parts() {
        fftw_destroy_plan(forward);
        fftw_destroy_plan(back);
    }
    Reals one;
    Reals other;
    fftw_plan forward = nullptr;
    fftw_plan back = nullptr;
};

FftwConvolution::FftwConvolution(std::size_t samples, std::size_t length, Planning planning, double longest_s)
    : samples_(samples), length_(length) {
    if (samples == 0 || length < samples || length > longest) {
        throw std::invalid_argument("expected a transform of at least as many as there are samples, at most 2^30");
    }
    parts_ = std::make_unique<Parts>(length);
    const unsigned flag = planning == Planning::measure ? FFTW_MEASURE : FFTW_ESTIMATE;
    const auto count = static_cast<int>(length);
    fftw_set_timelimit(longest_s);
    parts_->forward = fftw_plan_dft_r2c_1d(count, parts_->one.get(), spectrum(parts_->one), flag);
    parts_->back = fftw_plan_dft_c2r_1d(count, spectrum(parts_->one), parts_->one.get(), flag);
    fftw_set_timelimit(FFTW_NO_TIMELIMIT);
    fftw_forget_wisdom();  // else what was measured here would serve every estimate that follows
}

FftwConvolution::~FftwConvolution() = default;

void FftwConvolution::load(std::span<const double> one, std::span<const double> other) {
    fill(parts_->one, length_, one.first(samples_));
    fill(parts_->other, length_, other.first(samples_));
}

std::span<const double> FftwConvolution::run() {
    fftw_complex* const a = spectrum(parts_->one);
    fftw_complex* const b = spectrum(parts_->other);
    fftw_execute_dft_r2c(parts_->forward, parts_->one.get(), a);
    fftw_execute_dft_r2c(parts_->forward, parts_->other.get(), b);
    for (std::size_t m = 0; m <= length_ / 2; ++m) {
        const double real = a[m][0] * b[m][0] - a[m][1] * b[m][1];
        a[m][1] = a[m][0] * b[m][1] + a[m][1] * b[m][0];
        a[m][0] = real;
    }
    fftw_execute_dft_c2r(parts_->back, a, parts_->one.get());
    return {parts_->one.get(), samples_};
}

std::string FftwConvolution::version() { return fftw_version; }

}  // namespace bench
