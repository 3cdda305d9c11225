// std::inner_product. Compiled with -march=native -ffast-math: without leave to reorder, no compiler vectorises it.
#include <numeric>

#include "bench/host/peers/peer.hpp"

namespace bench {
namespace {

class StdDot final : public F32Dot {
public:
    explicit StdDot(const std::vector<float>& coefficients) : coefficients_(coefficients) {}
    float dot(const float* window) override {
        return std::inner_product(coefficients_.begin(), coefficients_.end(), window, 0.0F);
    }

private:
    std::vector<float> coefficients_;
};

}  // namespace

std::unique_ptr<F32Dot> make_std(const std::vector<float>& coefficients) {
    return std::make_unique<StdDot>(coefficients);
}

}  // namespace bench
