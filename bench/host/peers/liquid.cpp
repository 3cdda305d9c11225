// liquid-dsp: dotprod_rrrf.
#include <liquid/liquid.h>
#include <complex>  // before liquid.h, which then uses std::complex

#include "bench/host/peers/peer.hpp"

namespace bench {
namespace {

class LiquidDot final : public F32Dot {
public:
    explicit LiquidDot(std::vector<float> coefficients)
        : dot_(dotprod_rrrf_create(coefficients.data(), static_cast<unsigned>(coefficients.size()))) {}
    LiquidDot(const LiquidDot&) = delete;
    LiquidDot& operator=(const LiquidDot&) = delete;
    ~LiquidDot() override { dotprod_rrrf_destroy(dot_); }
    float dot(const float* window) override {
        float sum = 0.0F;
        dotprod_rrrf_execute(dot_, const_cast<float*>(window), &sum);  // it does not write
        return sum;
    }

private:
    dotprod_rrrf dot_;
};

}  // namespace

std::unique_ptr<F32Dot> make_liquid(const std::vector<float>& coefficients) {
    return std::make_unique<LiquidDot>(coefficients);
}

}  // namespace bench
