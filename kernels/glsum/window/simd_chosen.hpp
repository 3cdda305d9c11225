// The body of a vector loop for the best instruction set of this machine, chosen at the first call.
#pragma once

#include <atomic>

#include "glsum/window/simd_architectures.hpp"

namespace glsum {

/// \tparam Bodies  called with an architecture of xsimd it gives the address of the body that was compiled for it
template <class Bodies, class Function>
struct Chosen;

// Starts as a stub that asks the machine, then holds the answer: no guard and no static constructor on the way of a
// sample. Two threads that meet the stub at once store the same value.
template <class Bodies, class Result, class... Arguments>
struct Chosen<Bodies, Result(Arguments...)> {
    static Result call(Arguments... arguments) { return body_.load(std::memory_order_relaxed)(arguments...); }

private:
    static Result choose_and_call(Arguments... arguments) {
        const auto best = xsimd::dispatch<SimdArchitectures>(Bodies{})();
        body_.store(best, std::memory_order_relaxed);
        return best(arguments...);
    }

    static inline constinit std::atomic<Result (*)(Arguments...)> body_ = &choose_and_call;
};

}  // namespace glsum
