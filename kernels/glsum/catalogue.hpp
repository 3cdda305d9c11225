// The registry as facts: what kind of kernel a name stands for. One entry a kernel, made from its type at compile time,
// so that whoever has only the name need not search types, or the name, for it.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "glsum/computes_in_double.hpp"
#include "glsum/family.hpp"
#include "glsum/registry.hpp"

namespace glsum {

struct CatalogueEntry {
    std::string_view name;
    std::string_view history;  ///< the name's words; empty for `null`, which has none
    std::string_view technique;
    std::string_view format;
    bool fused = false;             ///< product and addition are rounded once
    std::string_view unfused = {};  ///< the technique of the same order that rounds both; its own if it does
    Family family = {"", "nothing: the time of a call"};
    Forgotten forgotten = Forgotten::zero;
    bool modes = false;       ///< a design has modes for it
    bool blocks = false;      ///< a design has blocks for it
    bool integrator = false;  ///< of exponentials: the slowest does not decay, for integrals alone
    bool in_halves = false;   ///< it answers before it settles (InHalves)
    bool host_only = false;   ///< it needs the host's vector unit
    std::size_t sample_bytes = 0;
    bool floating_point = false;  ///< its format's samples are floating-point numbers
    bool exact_sums = false;      ///< products and their sum are exact: every order of summation gives the same bits
    bool in_double = false;       ///< it computes in double precision: in software on a core without a double unit
    bool (*takes_order)(double order) = nullptr;  ///< the orders that `prepare` takes
};

template <Kernel K>
[[nodiscard]] constexpr CatalogueEntry catalogue_entry() {
    CatalogueEntry entry{.name = K::name(), .history = {}, .technique = {}, .format = {}};
    entry.in_halves = InHalves<K>;
    entry.host_only = K::host_only;
    entry.in_double = computes_in_double<K>();
    entry.sample_bytes = sizeof(typename K::Sample);
    if constexpr (requires { typename K::HistoryPart; }) {
        using History = typename K::HistoryPart;
        entry.history = History::word;
        entry.technique = K::TechniquePart::word;
        entry.format = K::FormatPart::word;
        entry.fused = K::TechniquePart::fused;
        entry.unfused = unfused_word_of<typename K::TechniquePart>();
        entry.floating_point = !K::FormatPart::fixed_point;
        entry.exact_sums = K::FormatPart::fixed_point;
        entry.takes_order = K::order_in_range;
        entry.integrator = has_integrator<History>;
        entry.modes = keeps_modes<History>;
        entry.blocks = keeps_blocks<History>;
        entry.family = History::family;
        entry.forgotten = forgotten_by<History>();
    } else {
        entry.takes_order = glsum::order_in_range;
    }
    return entry;
}

/// An entry for each kernel of `Registry`, in its order.
inline constexpr auto catalogue = [] {
    std::array<CatalogueEntry, Registry::count> entries{};
    std::size_t next = 0;
    Registry::for_each([&]<class K>() { entries[next++] = catalogue_entry<K>(); });
    return entries;
}();

/// The kernel of this name; null if there is none.
[[nodiscard]] constexpr const CatalogueEntry* find_kernel(std::string_view name) {
    for (const CatalogueEntry& entry : catalogue) {
        if (entry.name == name) {
            return &entry;
        }
    }
    return nullptr;
}

}  // namespace glsum
