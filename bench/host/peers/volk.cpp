// VOLK: volk_32f_x2_dot_prod_32f, which chooses its variant for the machine.
#include <volk/volk.h>

#include "bench/host/peers/peer.hpp"

namespace bench {
namespace {

class VolkDot final : public F32Dot {
public:
    explicit VolkDot(const std::vector<float>& coefficients) : coefficients_(coefficients) {}
    float dot(const float* window) override {
        float sum = 0.0F;
        volk_32f_x2_dot_prod_32f(&sum, coefficients_.data(), window, static_cast<unsigned>(coefficients_.size()));
        return sum;
    }

private:
    std::vector<float> coefficients_;
};

}  // namespace

std::unique_ptr<F32Dot> make_volk(const std::vector<float>& coefficients) {
    return std::make_unique<VolkDot>(coefficients);
}

}  // namespace bench
