// A run's rows by name: what has one value, and what was repeated.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "bench/rows/result_file.hpp"

namespace bench::gate {

/// What was measured under one name: the repetitions, without Google Benchmark's aggregates of them.
struct Measured {
    std::vector<const Json*> repetitions;  ///< at least one
    [[nodiscard]] const Json& first() const { return *repetitions.front(); }
    [[nodiscard]] bool wrong() const;  ///< one of them is marked
    [[nodiscard]] std::string error() const;
    /// Central processor's time per sample of each repetition, in ns.
    [[nodiscard]] std::vector<double> times() const;
};

class RowTable {
public:
    /// \param results  must outlive the table
    explicit RowTable(const Results& results);
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }  ///< in the order of the file
    [[nodiscard]] const Measured* find(const std::string& name) const;

private:
    std::vector<std::string> names_;
    std::unordered_map<std::string, Measured> rows_;
};

/// What kind of number a row holds, by its name.
enum class Kind { accuracy, host, target_count, target_model, other };
[[nodiscard]] Kind kind_of(const std::string& name);

/// Whether a field of a row is a counter: a number, and not one of Google Benchmark's own.
[[nodiscard]] bool is_counter(const std::string& key, const Json& value);

/// What all rows of its kernel, order and length share: what is moot once an answer there is wrong. Of another row, its
/// name.
[[nodiscard]] std::string subject_of(const std::string& name);

/// The kernel of a row; empty where the name has none.
[[nodiscard]] std::string kernel_of(const std::string& name);

/// The name of the same measurement of another kernel; the same name where it has none.
[[nodiscard]] std::string row_of(const std::string& kernel, const std::string& name);

}  // namespace bench::gate
