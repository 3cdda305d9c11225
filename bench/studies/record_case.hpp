// One size of whole records and the ways to its sums: what each took, turn by turn, and how far it was off.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench {

/// Of one record.
struct Seconds {
    double wall;
    double processor;
};

/// One record and what it is weighted with.
struct RecordTask {
    std::vector<double> weights;
    std::vector<double> record;
};

/// One way to the sums of a record.
struct RecordWay {
    std::string name;
    std::string label;
    bool full_memory;
    std::function<void(const RecordTask&)> load = {};                 ///< outside the timing; may be nothing
    std::function<std::vector<double>(const RecordTask&)> sums = {};  ///< of the task that was loaded
    std::function<void(const RecordTask&)> timed = {};                ///< the same without copies that only we need
    std::vector<Seconds> turns = {};
    double error_max = 0.0;  ///< relative to the largest sum
    std::string fault = {};

    [[nodiscard]] double processor_s() const;  ///< the median of the turns
    [[nodiscard]] double wall_s() const;       ///< likewise
};

struct RecordSize {
    std::size_t samples;
    RecordTask task;
    std::vector<RecordWay> ways;

    /// \pre there is one of this name
    [[nodiscard]] const RecordWay& way(std::string_view name) const;
};

/// \pre there is a value
[[nodiscard]] double median(std::vector<double> values);

/// Of the turns' ratios in processor time, the median: what disturbs the machine for a while is in both.
/// \pre as many turns of both
[[nodiscard]] double ratio(const RecordWay& way, const RecordWay& other);

/// How often a record is taken in a turn: so often that about 100 000 samples are, but once at least.
[[nodiscard]] std::size_t runs_a_turn(std::size_t samples);

/// A turn: of one record, the mean of its runs. Loading is outside the timing.
[[nodiscard]] Seconds time_once(const RecordWay& way, const RecordTask& task);

/// At which samples the sums are compared: the first, those about the borders of what is summed directly, the last of
/// each twelfth of the record. \pre at least 258 samples
[[nodiscard]] std::vector<std::size_t> compared_samples(std::size_t samples);

/// What the given weights promise of the sums of the order itself: the bound of the header, and the rounding of the
/// weights.
[[nodiscard]] double allowed_error(const RecordTask& task);

/// Remembers what a way with these sums errs on a signal. \param exact_errors  at the compared samples \param peak  the
/// largest sum \param limit  beyond it a way with full memory is wrong
void judge(RecordWay& way, std::string_view signal, std::span<const double> exact_errors, double peak, double limit);

/// \param size  with the two peers, at whose time its own is measured
[[nodiscard]] Json to_row(double order, const RecordSize& size, const RecordWay& way);

/// Of one order. \param sizes  rising
[[nodiscard]] std::string to_table(double order, const std::vector<RecordSize>& sizes);

}  // namespace bench
