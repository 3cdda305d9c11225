#include "glsum/window/simd_chosen.hpp"
#include "glsum/window/simd_dot_arch.hpp"

namespace glsum {
namespace {

template <class T, bool fused>
struct Dots {
    template <class Architecture>
    auto operator()(Architecture) const {
        return &simd_dot_on<T, fused, Architecture>;
    }
};
template <class T, bool fused>
using BestDot = Chosen<Dots<T, fused>, T(const T*, const T*, std::size_t)>;

template <class T, bool fused>
struct Slides {
    template <class Architecture>
    auto operator()(Architecture) const {
        return &simd_slide_on<T, fused, Architecture>;
    }
};
template <class T, bool fused>
using BestSlide = Chosen<Slides<T, fused>, T(const T*, const T*, T*, std::size_t, T)>;

struct Name {
    template <class Architecture>
    const char* operator()(Architecture) const {
        return Architecture::name();
    }
};

}  // namespace

template <class T, bool fused>
T simd_dot(const T* a, const T* x, std::size_t blocks) {
    return BestDot<T, fused>::call(a, x, blocks);
}
template <class T, bool fused>
T simd_slide(const T* a, const T* x, T* recent, std::size_t blocks, T newest) {
    return BestSlide<T, fused>::call(a, x, recent, blocks, newest);
}

#define GLSUM_SIMD_BODIES(type, fused)                                          \
    template type simd_dot<type, fused>(const type*, const type*, std::size_t); \
    template type simd_slide<type, fused>(const type*, const type*, type*, std::size_t, type);
GLSUM_SIMD_BODIES(float, false)
GLSUM_SIMD_BODIES(float, true)
GLSUM_SIMD_BODIES(double, false)
GLSUM_SIMD_BODIES(double, true)
#undef GLSUM_SIMD_BODIES

std::string_view simd_instruction_set() { return xsimd::dispatch<SimdArchitectures>(Name{})(); }

}  // namespace glsum
