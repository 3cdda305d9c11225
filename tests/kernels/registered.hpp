// The registry as GoogleTest's type list: a test body written once runs for every kernel, under its name.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bench/host_line.hpp"
#include "glsum/registry.hpp"

namespace test {

template <class List>
struct AsTypes;
template <class Null, class... Ks>
struct AsTypes<glsum::KernelList<Null, Ks...>> {
    using Types = testing::Types<Ks...>;
};
/// Every kernel but `null`.
using Kernels = AsTypes<glsum::Registry>::Types;

template <class List, class... Kept>
struct FixedOf;
template <class... Kept>
struct FixedOf<testing::Types<>, Kept...> {
    using Types = testing::Types<Kept...>;
};
template <class K, class... Rest, class... Kept>
struct FixedOf<testing::Types<K, Rest...>, Kept...>
    : std::conditional_t<K::FormatPart::fixed_point, FixedOf<testing::Types<Rest...>, Kept..., K>,
                         FixedOf<testing::Types<Rest...>, Kept...>> {};
/// The fixed-point kernels.
using FixedKernels = FixedOf<Kernels>::Types;

struct KernelNames {
    template <class K>
    static std::string GetName(int) {
        return std::string(K::name());
    }
};

template <class K>
using Line = bench::HostLine<K>;

}  // namespace test
