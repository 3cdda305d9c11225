#include "glsum/lookahead/simd_block.hpp"

#include "glsum/lookahead/simd_block_arch.hpp"
#include "glsum/window/simd_chosen.hpp"

namespace glsum {
namespace {

template <class T, bool fused>
struct Bodies {
    template <class Architecture>
    auto operator()(Architecture) const {
        return &simd_block_on<T, fused, Architecture>;
    }
};

template <class T, bool fused>
using Best = Chosen<Bodies<T, fused>, T(SimdBlock<T>&, T)>;

}  // namespace

float simd_block_step(SimdBlock<float>& block, float newest) { return Best<float, false>::call(block, newest); }
double simd_block_step(SimdBlock<double>& block, double newest) { return Best<double, false>::call(block, newest); }
float simd_block_step_fused(SimdBlock<float>& block, float newest) { return Best<float, true>::call(block, newest); }
double simd_block_step_fused(SimdBlock<double>& block, double newest) {
    return Best<double, true>::call(block, newest);
}

}  // namespace glsum
