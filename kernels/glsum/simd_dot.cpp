#include <atomic>

#include "glsum/simd_dot_arch.hpp"

namespace glsum {
namespace {

template <class T>
using Dot = T (*)(const T*, const T*, std::size_t);

template <class T, bool fused>
struct Choose {
    template <class Architecture>
    Dot<T> operator()(Architecture) const {
        return &simd_dot_on<T, fused, Architecture>;
    }
};

// Starts as a stub that asks the machine, then holds the answer: no guard and no static constructor on the way of a
// sample. Two threads that meet the stub at once store the same value.
template <class T, bool fused>
T choose_and_call(const T* a, const T* x, std::size_t blocks);

template <class T, bool fused>
constinit std::atomic<Dot<T>> chosen = &choose_and_call<T, fused>;

template <class T, bool fused>
T choose_and_call(const T* a, const T* x, std::size_t blocks) {
    const Dot<T> best = xsimd::dispatch<SimdArchitectures>(Choose<T, fused>{})();
    chosen<T, fused>.store(best, std::memory_order_relaxed);
    return best(a, x, blocks);
}

struct Name {
    template <class Architecture>
    const char* operator()(Architecture) const {
        return Architecture::name();
    }
};

}  // namespace

float simd_dot(const float* a, const float* x, std::size_t blocks) {
    return chosen<float, false>.load(std::memory_order_relaxed)(a, x, blocks);
}

double simd_dot(const double* a, const double* x, std::size_t blocks) {
    return chosen<double, false>.load(std::memory_order_relaxed)(a, x, blocks);
}

float simd_dot_fused(const float* a, const float* x, std::size_t blocks) {
    return chosen<float, true>.load(std::memory_order_relaxed)(a, x, blocks);
}

double simd_dot_fused(const double* a, const double* x, std::size_t blocks) {
    return chosen<double, true>.load(std::memory_order_relaxed)(a, x, blocks);
}

std::string_view simd_instruction_set() { return xsimd::dispatch<SimdArchitectures>(Name{})(); }

}  // namespace glsum
