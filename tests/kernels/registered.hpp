// The registry as GoogleTest's type list, for tests that look into a kernel's own types; for all others see
// any_kernel.hpp.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bench/sweep/host_line.hpp"
#include "glsum/registry.hpp"
#include "reference/dropped.hpp"

namespace test {

template <class List>
struct AsTypes;
template <class Null, class... Ks>
struct AsTypes<glsum::KernelList<Null, Ks...>> {
    using Types = testing::Types<Ks...>;
};
/// Every kernel but `null`.
using Kernels = AsTypes<glsum::Registry>::Types;

template <template <class> class Wanted, class List, class... Kept>
struct Filter;
template <template <class> class Wanted, class... Kept>
struct Filter<Wanted, testing::Types<>, Kept...> {
    using Types = testing::Types<Kept...>;
};
template <template <class> class Wanted, class K, class... Rest, class... Kept>
struct Filter<Wanted, testing::Types<K, Rest...>, Kept...>
    : std::conditional_t<Wanted<K>::value, Filter<Wanted, testing::Types<Rest...>, Kept..., K>,
                         Filter<Wanted, testing::Types<Rest...>, Kept...>> {};

/// Whether a kernel takes what leaves its window as 0; the others' order is stated in dropped_kernel_test.cpp.
template <class K>
inline constexpr bool takes_zero = glsum::forgotten_by<typename K::HistoryPart>() == reference::Dropped::zero;

template <class K>
using IsFixed = std::bool_constant<K::FormatPart::fixed_point && takes_zero<K>>;
/// Floating point with an order that scalar code can state; the vector kernels have a test of their own.
template <class K>
using IsScalarFloating = std::bool_constant<!K::FormatPart::fixed_point && !K::host_only && takes_zero<K>>;

using FixedKernels = Filter<IsFixed, Kernels>::Types;
using FloatingKernels = Filter<IsScalarFloating, Kernels>::Types;

struct KernelNames {
    template <class K>
    static std::string GetName(int) {
        return std::string(K::name());
    }
};

template <class K>
using Line = bench::HostLine<K>;

}  // namespace test
