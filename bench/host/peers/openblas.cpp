// OpenBLAS: cblas_sdot, on one thread.
#include <cblas.h>

#include "bench/host/peers/peer.hpp"

extern "C" void openblas_set_num_threads(int threads);

namespace bench {
namespace {

class OpenblasDot final : public F32Dot {
public:
    explicit OpenblasDot(const std::vector<float>& coefficients) : coefficients_(coefficients) {
        openblas_set_num_threads(1);
    }
    float dot(const float* window) override {
        return cblas_sdot(static_cast<int>(coefficients_.size()), coefficients_.data(), 1, window, 1);
    }

private:
    std::vector<float> coefficients_;
};

}  // namespace

std::unique_ptr<F32Dot> make_openblas(const std::vector<float>& coefficients) {
    return std::make_unique<OpenblasDot>(coefficients);
}

}  // namespace bench
