// Measurements of an earlier run, where they hold for this build.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/choose/question.hpp"
#include "bench/rows/key.hpp"
#include "bench/rows/result_file.hpp"

namespace choose {

/// What of a result file may be used, and why the rest may not.
struct Earlier {
    std::vector<bench::Json> rows;
    bool errors = false;     ///< accuracy rows: same build, weights, record and seed, at h = 1 ms
    bool on_target = false;  ///< m7 rows: the same firmware, by its hash, and of a modelled core the same file
    std::string note;        ///< one sentence
};

/// How a question counts the length of a row; nothing for one that it does not ask for: longer than its record, or of
/// other numbers of taps and modes than designs of that length have.
[[nodiscard]] std::optional<std::size_t> taps_of(const bench::RowKey& key, const CountedOrder& order,
                                                 std::size_t samples);

/// \param context  of this run, as `bench::make_context` gives it
[[nodiscard]] Earlier read_earlier(const Question& question, const bench::Json& context);

/// Hands the usable rows to the sources.
void remember(const Earlier& earlier, const Question& question, MeasuredErrors& errors);
void remember(const Earlier& earlier, const Question& question, OnTarget& costs);

}  // namespace choose
