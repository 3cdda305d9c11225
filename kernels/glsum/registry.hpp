// The registry as types. See registry.def for the list itself.
#pragma once

#define GLSUM_FAMILIES_SUMS
#include "glsum/families.def"
#undef GLSUM_FAMILIES_SUMS

#include "glsum/format/fixed.hpp"
#include "glsum/format/floating.hpp"
#include "glsum/kernel.hpp"
#include "glsum/null.hpp"
#include "glsum/window/compensated.hpp"
#include "glsum/window/fir.hpp"
#include "glsum/window/horner.hpp"
#include "glsum/window/hornersplit.hpp"
#include "glsum/window/mirror.hpp"
#include "glsum/window/multi.hpp"
#include "glsum/window/oldest.hpp"
#include "glsum/window/paired.hpp"
#include "glsum/window/pairwise.hpp"
#include "glsum/window/plain.hpp"
#include "glsum/window/ring.hpp"
#include "glsum/window/scaled.hpp"
#include "glsum/window/shift.hpp"
#include "glsum/window/simd.hpp"

namespace glsum {

// Each kernel by its published name: `glsum::Line<glsum::ring_plain_f32, 600>`.
using null = Null;
#define GLSUM_KERNEL(published, history, technique, format)                                                \
    using published = Sum<history, technique, format>;                                                     \
    static_assert(published::name() == #published, "registry.def: a kernel's name is what its words say"); \
    template <>                                                                                            \
    inline constexpr bool is_registered<published> = true;
#if defined(GLSUM_SIMD)
#define GLSUM_HOST_KERNEL GLSUM_KERNEL
#else
#define GLSUM_HOST_KERNEL(published, history, technique, format)
#endif
#include "glsum/registry.def"
#undef GLSUM_KERNEL
#undef GLSUM_HOST_KERNEL

/// Every kernel of this build: `null` first. Bare metal and GLSUM_SIMD=OFF leave out the host's own.
using Registry = KernelList<Null
#define GLSUM_KERNEL(published, history, technique, format) , published
#if defined(GLSUM_SIMD)
#define GLSUM_HOST_KERNEL GLSUM_KERNEL
#else
#define GLSUM_HOST_KERNEL(published, history, technique, format)
#endif
#include "glsum/registry.def"
#undef GLSUM_KERNEL
#undef GLSUM_HOST_KERNEL
                            >;

}  // namespace glsum
