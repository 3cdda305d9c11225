// The registry as types. See registry.def for the list itself.
#pragma once

#include "glsum/block_sum.hpp"
#include "glsum/delta_sum.hpp"
#include "glsum/format/fixed.hpp"
#include "glsum/format/floating.hpp"
#include "glsum/history/mirror.hpp"
#include "glsum/history/ring.hpp"
#include "glsum/history/shift.hpp"
#include "glsum/integral_sum.hpp"
#include "glsum/kernel.hpp"
#include "glsum/modes_sum.hpp"
#include "glsum/nested_sum.hpp"
#include "glsum/null.hpp"
#include "glsum/simd_block_sum.hpp"
#include "glsum/sum.hpp"
#include "glsum/tail_sum.hpp"
#include "glsum/technique/compensated.hpp"
#include "glsum/technique/fir.hpp"
#include "glsum/technique/horner.hpp"
#include "glsum/technique/hornersplit.hpp"
#include "glsum/technique/multi.hpp"
#include "glsum/technique/oldest.hpp"
#include "glsum/technique/paired.hpp"
#include "glsum/technique/plain.hpp"
#include "glsum/technique/scaled.hpp"
#include "glsum/technique/simd.hpp"

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
