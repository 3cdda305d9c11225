// Eigen's dot of two mapped vectors. Header-only: compiled with -march=native -ffast-math.
#include <Eigen/Core>

#include "bench/host/peers/peer.hpp"

namespace bench {
namespace {

class EigenDot final : public F32Dot {
public:
    explicit EigenDot(const std::vector<float>& coefficients)
        : coefficients_(
              Eigen::Map<const Eigen::VectorXf>(coefficients.data(), static_cast<Eigen::Index>(coefficients.size()))) {}
    float dot(const float* window) override {
        return coefficients_.dot(Eigen::Map<const Eigen::VectorXf>(window, coefficients_.size()));
    }

private:
    Eigen::VectorXf coefficients_;
};

}  // namespace

std::unique_ptr<F32Dot> make_eigen(const std::vector<float>& coefficients) {
    return std::make_unique<EigenDot>(coefficients);
}

}  // namespace bench
