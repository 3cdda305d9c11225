// The bodies of all kernels, once, in the library: size, stack and cycles are those of the object code that ships. In
// one unit, since a sum that wraps another holds its body.
#include "glsum/registry.hpp"

// Behind the types of the registry: what compilers make of the bodies depends on it.
#define GLSUM_FAMILIES_BODIES
#include "glsum/families.def"
#undef GLSUM_FAMILIES_BODIES

namespace glsum {

Status Null::prepare(State&, const Design& design, std::span<float>, std::span<float>) {
    return design.taps == 0 ? Status::no_taps : order_in_range(design.order) ? Status::ok : Status::order_out_of_range;
}
void Null::reset(State&) {}
float Null::step(State&, float newest) { return newest; }

#define GLSUM_KERNEL(published, history, technique, format) template struct Sum<history, technique, format>;
#if defined(GLSUM_SIMD)
#define GLSUM_HOST_KERNEL GLSUM_KERNEL
#else
#define GLSUM_HOST_KERNEL(published, history, technique, format)
#endif
#include "glsum/registry.def"

}  // namespace glsum
