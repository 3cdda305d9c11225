#include "bench/rows/counters.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace bench {
namespace {

constexpr CounterFacts table[] = {
#define GLSUM_COUNTER(name, unit, better, layer, shown, digits, title, meaning) \
    {#name, unit, Role::counter, Better::better, CounterLayer::layer, Shown::shown, Digits::digits, title, meaning},
#define GLSUM_COUNTER_FAMILY(name, prefix, unit, better, layer, shown, digits, title, meaning) \
    {prefix,       unit,           Role::counter, Better::better, CounterLayer::layer,         \
     Shown::shown, Digits::digits, title,         meaning,        true},
#define GLSUM_BOOKKEEPING(name, role, unit, shown, meaning)                   \
    {#name,                                                                   \
     unit,                                                                    \
     Role::role,                                                              \
     Role::role == Role::time ? Better::lower : Better::neither,              \
     Role::role == Role::time ? CounterLayer::host_time : CounterLayer::none, \
     Shown::shown,                                                            \
     Digits::seven,                                                           \
     "",                                                                      \
     meaning},
#include "bench/rows/counters.def"
#undef GLSUM_COUNTER
#undef GLSUM_COUNTER_FAMILY
#undef GLSUM_BOOKKEEPING
};

// The lines of the counters, or of the families: an enumerator's value is its place among them.
template <bool families>
constexpr auto lines_of() {
    std::array<const CounterFacts*, std::ranges::count(table, families, &CounterFacts::is_family)> lines{};
    auto line = lines.begin();
    for (const CounterFacts& facts : table) {
        if (facts.is_family == families) {
            *line++ = &facts;
        }
    }
    return lines;
}

constexpr auto lines_of_counters = lines_of<false>();
constexpr auto lines_of_families = lines_of<true>();

// Sorted by name, to be looked up: every field of every row of a file is.
const std::array<const CounterFacts*, std::size(table)>& by_name() {
    static const auto sorted = [] {
        std::array<const CounterFacts*, std::size(table)> lines{};
        std::transform(std::begin(table), std::end(table), lines.begin(),
                       [](const CounterFacts& line) { return &line; });
        std::sort(lines.begin(), lines.end(),
                  [](const auto* one, const auto* other) { return one->name < other->name; });
        return lines;
    }();
    return sorted;
}

}  // namespace

std::span<const CounterFacts> counter_table() { return table; }

const CounterFacts& facts_of(Counter counter) { return *lines_of_counters[static_cast<std::size_t>(counter)]; }

const CounterFacts& facts_of(CounterFamily family) { return *lines_of_families[static_cast<std::size_t>(family)]; }

std::string_view name_of(Counter counter) { return facts_of(counter).name; }

std::string member_of(CounterFamily family, std::string_view which) {
    return std::string(facts_of(family).name) += which;
}

const CounterFacts* find_counter(std::string_view field) {
    const auto& sorted = by_name();
    // The last that is no larger: the field itself, or the prefix that it begins with if there is one.
    auto behind = std::upper_bound(sorted.begin(), sorted.end(), field,
                                   [](std::string_view name, const CounterFacts* line) { return name < line->name; });
    if (behind == sorted.begin()) {
        return nullptr;
    }
    const CounterFacts& line = **--behind;
    return line.name == field || (line.is_family && field.starts_with(line.name)) ? &line : nullptr;
}

bool is_measured(std::string_view field) {
    const CounterFacts* facts = find_counter(field);
    return facts == nullptr || facts->role == Role::counter;
}

std::string_view name_of(CounterLayer layer) {
    switch (layer) {
        case CounterLayer::none:
            return "none";
        case CounterLayer::accuracy:
            return "accuracy";
        case CounterLayer::instructions_and_bytes:
            return "instructions_and_bytes";
        case CounterLayer::model_cycles:
            return "model_cycles";
        case CounterLayer::host_time:
            return "host_time";
    }
    return "";
}

std::string_view name_of(Better better) {
    switch (better) {
        case Better::lower:
            return "lower";
        case Better::higher:
            return "higher";
        case Better::equal:
            return "equal";
        case Better::neither:
            return "neither";
    }
    return "";
}

}  // namespace bench
