// What can be read off the rows of a run.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench {

/// The parts of "gl/<kernel>/order:<v>/taps:<L>/<aspect>[/signal:<s>[/amplitude:<a>]]".
struct RowKey {
    std::string kernel;
    std::string order;
    std::string taps;
    std::string aspect;  ///< accuracy, host, m7:<core>
    std::string signal;
    std::string amplitude;  ///< empty: 1
};
/// Empty for another kind of row, and for one whose parts are not what ours are: words of letters and digits, numbers,
/// lengths, and nothing more behind them.
[[nodiscard]] std::optional<RowKey> parse_key(const std::string& name);

/// A text as one field of a CSV line (RFC 4180): in quotes where it holds a comma, a quote or a line's end.
[[nodiscard]] std::string csv_field(const std::string& text);

/// One line a row; the columns are the parts of the name and every counter that occurs (RFC 4180).
[[nodiscard]] std::string to_csv(const std::vector<Json>& rows);
void write_csv(const std::filesystem::path& path, const std::vector<Json>& rows);

/// The length of "<near>[+<modes>]": how many terms its sum has. Nothing for `full`, whose length the name does not
/// tell, and for what is no length.
[[nodiscard]] std::optional<double> taps_number(const std::string& taps);

/// Modelled cycles per sample, with the band over the rule sets that fit silicon equally.
struct ModelCycles {
    double median;
    std::optional<double> low;
    std::optional<double> high;
};

/// What one kernel does at one order and length.
struct Entry {
    std::string kernel;
    std::optional<double> error_max;           ///< worst of the signals
    std::optional<double> rounding_error_max;  ///< worst of the signals
    std::optional<double> truncation_error_max;
    std::optional<double> host_ns;      ///< median of the repetitions
    std::optional<double> host_cycles;  ///< likewise
    std::optional<double> target_instructions;
    std::optional<double> target_worst;
    std::map<std::string, ModelCycles> model_cycles;  ///< by core
    std::optional<double> effective_taps;
    std::optional<double> bytes;  ///< state and coefficients; on the target where it runs there
    bool software_double = false;
    std::string fault;  ///< why it may not be ranked; empty if it may
    bool host_front = false;
    bool target_front = false;
};

/// All kernels of one order and length, in the order of their appearance.
struct Group {
    std::string order;
    std::string taps;
    std::vector<Entry> entries;
};

/// Groups by order and length, in the order of their appearance. Host timings, taken at one order, serve all;
/// of repetitions the median counts.
/// `host_front`, `target_front`: no other kernel of the group costs less (nanoseconds; instructions) at an error that
/// is at most 1 % larger, which counts as the same.
[[nodiscard]] std::vector<Group> group(const std::vector<Json>& rows);

}  // namespace bench
