// std::inner_product of 32-bit integers into 64 bits, with the flags of our own kernels: scalar code that fills the
// core. Beside a kernel it says what such code suffers from a neighbour, which vector code does not tell.
#include <functional>
#include <numeric>

#include "bench/host/peers/peer.hpp"

namespace bench {
namespace {

class StdQ31Dot final : public Q31Dot {
public:
    explicit StdQ31Dot(const std::vector<std::int32_t>& coefficients) : coefficients_(coefficients) {}
    std::int64_t dot(const std::int32_t* window) override {
        return std::inner_product(coefficients_.begin(), coefficients_.end(), window, std::int64_t{0}, std::plus<>(),
                                  [](std::int32_t a, std::int32_t x) { return std::int64_t{a} * x; });
    }

private:
    std::vector<std::int32_t> coefficients_;
};

}  // namespace

std::unique_ptr<Q31Dot> make_std_q31(const std::vector<std::int32_t>& coefficients) {
    return std::make_unique<StdQ31Dot>(coefficients);
}

}  // namespace bench
