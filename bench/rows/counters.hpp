// What the numbers of a row mean: the table of counters.def as facts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace bench {

/// A number of a row, asked for by name: Counter::error_max.
enum class Counter {
#define GLSUM_COUNTER(name, unit, better, layer, shown, digits, title, meaning) name,
#define GLSUM_COUNTER_FAMILY(name, prefix, unit, better, layer, shown, digits, title, meaning)
#define GLSUM_BOOKKEEPING(name, role, unit, shown, meaning) name,
#include "bench/rows/counters.def"
#undef GLSUM_COUNTER
#undef GLSUM_COUNTER_FAMILY
#undef GLSUM_BOOKKEEPING
};

/// Counters of one prefix whose end is open.
enum class CounterFamily {
    stall,  ///< stall_<cause>: cycles lost to it
};

enum class Role {
    counter,  ///< what was measured
    time,     ///< of a sample
    effort,   ///< how long was measured
    index,    ///< which measurement it is
};
enum class Better { lower, higher, equal, neither };
/// Which layer of the gate judges a counter.
enum class CounterLayer { none, accuracy, instructions_and_bytes, model_cycles, host_time };
/// How much of the report's page shows it; each shows what the one before does.
enum class Shown { nowhere, listed, compared, drawn };
/// How many digits the page needs.
enum class Digits { seven, four };

/// A line of the table.
struct CounterFacts {
    std::string_view name;  ///< of a family: what its members' names begin with
    std::string_view unit;
    Role role;
    Better better;
    CounterLayer layer;
    Shown shown;
    Digits digits;
    std::string_view title;  ///< empty where the name will do
    std::string_view meaning;
    bool is_family = false;
};

/// The whole table in its order.
[[nodiscard]] std::span<const CounterFacts> counter_table();

[[nodiscard]] const CounterFacts& facts_of(Counter counter);
[[nodiscard]] const CounterFacts& facts_of(CounterFamily family);
[[nodiscard]] std::string_view name_of(Counter counter);
/// "stall_load_use"
[[nodiscard]] std::string member_of(CounterFamily family, std::string_view which);

/// What the table says of a field of a row, be it a counter's or a family's; null of one that is not in it.
[[nodiscard]] const CounterFacts* find_counter(std::string_view field);

/// Whether a number of that name is something measured. One that the table does not know is: of another program, whose
/// rows are compared and guarded as ours are.
[[nodiscard]] bool is_measured(std::string_view field);

[[nodiscard]] std::string_view name_of(CounterLayer layer);
[[nodiscard]] std::string_view name_of(Better better);

}  // namespace bench
