// Result rows in Google Benchmark's schema: made with Row, read with value_of.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "bench/rows/counters.hpp"
#include "glsum/kernel.hpp"

namespace bench {

struct RowKey;

using Json = nlohmann::ordered_json;

/// A row that Google Benchmark did not make itself: the fields that its tools expect, times 0.
[[nodiscard]] Json make_row(const std::string& name, std::size_t iterations);

/// Marks a row as wrong or impossible: such rows are never ranked.
void mark_error(Json& row, const std::string& message);
[[nodiscard]] bool is_wrong(const Json& row);
/// Whether it has a time: measured on the host, or modelled. Rows of accuracy and of instructions alone have none.
[[nodiscard]] bool is_timed(const Json& row);

/// A counter of a row; nothing where it has none.
[[nodiscard]] std::optional<double> value_of(const Json& row, Counter counter);

/// A row that is being made: it takes the counters of the table and no others.
class Row {
public:
    Row(const RowKey& key, std::size_t iterations);
    /// One that was made before, to say more of it.
    explicit Row(Json made) : json_(std::move(made)) {}

    template <class Number>
    requires std::is_arithmetic_v<Number>
    void set(Counter counter, Number value) { json_[std::string(name_of(counter))] = value; }
    /// \param which  ends the name: a cause
    void set(CounterFamily family, std::string_view which, double value) { json_[member_of(family, which)] = value; }
    /// A sample's time, of the wall's clock and of the processor alike.
    void set_time(double ns);
    /// What it says in words.
    void set_text(const char* field, std::string_view text) { json_[field] = text; }
    void mark_error(const std::string& message) { bench::mark_error(json_, message); }

    [[nodiscard]] Json take() && { return std::move(json_); }

private:
    Json json_;
};

[[nodiscard]] std::string to_text(glsum::Status status);

}  // namespace bench
