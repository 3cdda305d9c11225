// The kernels' names and entries, for the host to read from the ELF: which calls the emulator's plugin is to watch.
#pragma once

#include <cstdint>

#include "glsum/registry.hpp"

namespace firmware {

// One after the other in memory, as an array would be: rows of { name, its length, entry, entry of its first half or 0
// }. An array would need casts of the entries, which no constant may hold, and the table must be there without running
// anything.
template <class K>
constexpr auto first_half() -> typename K::Output (*)(typename K::State&, typename K::Sample) {
    if constexpr (glsum::InHalves<K>) {
        return &K::answer;
    } else {
        return nullptr;
    }
}

template <class K, class... Rest>
struct WatchTable {
    const char* name = K::name().data();
    std::uint32_t name_length = K::name().size();
    typename K::Output (*entry)(typename K::State&, typename K::Sample) = &K::step;
    typename K::Output (*answer)(typename K::State&, typename K::Sample) = first_half<K>();
    WatchTable<Rest...> rest;
};
template <class K>
struct WatchTable<K> {
    const char* name = K::name().data();
    std::uint32_t name_length = K::name().size();
    typename K::Output (*entry)(typename K::State&, typename K::Sample) = &K::step;
    typename K::Output (*answer)(typename K::State&, typename K::Sample) = first_half<K>();
};
template <class... Ks>
constexpr WatchTable<Ks...> make_watch_table(glsum::KernelList<Ks...>) {
    return {};
}
using Watched = decltype(make_watch_table(glsum::Registry{}));
static_assert(sizeof(Watched) == 16 * glsum::Registry::count);

}  // namespace firmware

extern "C" {
extern const firmware::Watched glsum_watched;
extern const std::uint32_t glsum_watched_count;
constinit const firmware::Watched glsum_watched = firmware::make_watch_table(glsum::Registry{});
const std::uint32_t glsum_watched_count = glsum::Registry::count;
}

namespace firmware {

/// To be called by the program, or the linker would drop the table.
inline void keep_watch_table() { asm volatile("" ::"r"(&glsum_watched), "r"(&glsum_watched_count)); }

}  // namespace firmware
