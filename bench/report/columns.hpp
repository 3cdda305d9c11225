// Rows as columns, small enough for a page.
#pragma once

#include <string>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench::report {

/// {"values": [distinct values], "bits": 6, 8, 16 or 32, "at": base64 of little-endian indices into them, of 6 bits one
/// letter an index}; without "at" when there is one value.
[[nodiscard]] Json encode_texts(const std::vector<std::string>& column);

/// The same with numbers rounded to 7 digits, NaN (no value) as null; where most values differ,
/// {"float32": base64 of little-endian floats, NaN for no value}.
[[nodiscard]] Json encode_numbers(const std::vector<double>& column);

/// The same of errors, which are many, all different, and of no use beyond four digits: beyond 4096 different ones
/// {"float24": base64 of the upper three bytes, little-endian, of rounded floats}, good to 2e-5.
[[nodiscard]] Json encode_errors(const std::vector<double>& column);

/// The rows in one table for each aspect (accuracy, host, m7:<core>; "other" for names of another kind):
/// {"aspect", "rows": n, "texts": {kernel, order, taps, signal, name, label, fault: column}, "numbers": {counter:
/// column}}. Rows other than single measurements (means and the like) are left out. `signal` is "<s>" or "<s>,
/// amplitude <a>"; `name` is there for other rows alone; `fault` is the reason of rows that are wrong, else empty.
/// \throws glsum::Failure (bad input) for more than 64 counters `stall_*`.
[[nodiscard]] Json to_tables(const std::vector<Json>& rows);

}  // namespace bench::report
