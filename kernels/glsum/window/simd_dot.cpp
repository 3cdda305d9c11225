#include "glsum/window/simd_chosen.hpp"
#include "glsum/window/simd_dot_arch.hpp"

namespace glsum {
namespace {

template <class T, bool fused>
struct Bodies {
    template <class Architecture>
    auto operator()(Architecture) const {
        return &simd_dot_on<T, fused, Architecture>;
    }
};

template <class T, bool fused>
using Best = Chosen<Bodies<T, fused>, T(const T*, const T*, std::size_t)>;

struct Name {
    template <class Architecture>
    const char* operator()(Architecture) const {
        return Architecture::name();
    }
};

}  // namespace

float simd_dot(const float* a, const float* x, std::size_t blocks) { return Best<float, false>::call(a, x, blocks); }
double simd_dot(const double* a, const double* x, std::size_t blocks) {
    return Best<double, false>::call(a, x, blocks);
}
float simd_dot_fused(const float* a, const float* x, std::size_t blocks) {
    return Best<float, true>::call(a, x, blocks);
}
double simd_dot_fused(const double* a, const double* x, std::size_t blocks) {
    return Best<double, true>::call(a, x, blocks);
}

std::string_view simd_instruction_set() { return xsimd::dispatch<SimdArchitectures>(Name{})(); }

}  // namespace glsum
