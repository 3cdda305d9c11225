// Logs of a drive: CSV as loggers write it. What is wrong with a file is said with its line; what is odd about its
// stamps is found, counted and handled in one place.
//
//   # comment
//   time_s,duty,angle_rad
//   0.0000,0.27,0.0000
//
// Columns: `time_s`; the input, `input` or `duty`; the output, `output`, `y`, `angle_rad` or `counts`. Others are
// ignored unless an option names them, by name or by number from 1. Where none of these is there, what loggers usually
// write is taken, in any case (single letters in small ones), with a unit in brackets or without:
//
//   time    `time`, `t`, `timestamp`, `datetime`, also with a unit of time (`t_ms`, `time [us]`); `millis`, `micros`
//   input   `u`, `cmd`, `command`, `pwm`, `input [V]`
//   output  `measured`, `measurement`, `output [mm]`
//
// Beyond this plain form a reader finds, and says in one line: a byte order mark; semicolons, tabs or runs of blanks
// for the commas; decimal commas; quoted fields; a row of units; no header, where columns 1, 2 and 3 are time, input
// and output; stamps in another unit, which the header or the row of units names; dates and times since 1970, which
// count from the first. Ends of lines may be of either kind. Thousands are never grouped. What may be read in two ways
// is refused.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace drive {

/// Bounds of what is read.
struct LogLimits {
    static constexpr std::size_t bytes = 512u << 20;
    static constexpr std::size_t samples = 10'000'000;
    static constexpr std::size_t line = 1u << 16;
};

/// Which columns to take, where the header's usual names do not say.
struct Columns {
    std::string time = {};
    std::string input = {};
    std::string output = {};
    std::vector<std::string> more_inputs = {};  ///< further logged inputs, in this order
    std::string simulated = {};                 ///< what the user's own simulator gave, in the output's units
    bool needs_input = true;
    bool needs_output = true;                    ///< false: it is 0 throughout, unless it is named
    std::string reference = {};                  ///< of a closed loop; usually `reference`
    bool takes_reference = false;                ///< where the log has such a column, it need not have an input
    std::optional<double> counts_per_unit = {};  ///< the output is divided by it
    int counter_bits = 0;  ///< counts come from a counter of so many bits that wraps; 0: they must not
    // Empty: as the file shows.
    std::string separator = {};  ///< comma, semicolon, tab or blank
    std::string decimal = {};    ///< point or comma
    std::string time_unit = {};  ///< ns, us, ms, s, min or h
};

/// Stamps as the logger wrote them, in order of lines.
struct Log {
    std::string name;
    std::vector<double> time_s;
    std::vector<double> input;  ///< empty if there is none and none is needed
    std::vector<double> output;
    std::vector<std::vector<double>> more_inputs;  ///< one for each that was named
    std::vector<double> simulated;                 ///< empty unless it was named
    std::vector<double> reference;                 ///< empty unless it was asked for and is there
    std::vector<std::size_t> line;                 ///< of each sample, for messages
    std::vector<std::string> warnings;
};

/// \throws glsum::Failure (bad input) naming file, line, what was expected and what was found: no header, a column
/// missing or twice, a row with another number of fields, a field that is no finite number, two ways to read it, a
/// counter that wraps, a duty outside 0 to 1, fewer than 2 samples.
[[nodiscard]] Log parse_log(const std::string& text, const std::string& name, const Columns& columns = {});

/// What was odd about the stamps of a log, and what was done.
struct StampReport {
    std::size_t repeated = 0;        ///< stamps equal to the one before
    std::size_t backward = 0;        ///< stamps before the latest one
    bool spread = false;             ///< the repeated ones were bursts; each sample now has a stamp of its own
    std::size_t missing = 0;         ///< samples that the gaps are short of, at the usual interval
    std::size_t first_repeated = 0;  ///< lines; 0 where there is none
    std::size_t first_backward = 0;
    std::size_t first_gap = 0;
    double usual_interval_s = 0.0;  ///< the median
    double smallest_interval_s = 0.0;
    double largest_interval_s = 0.0;
    [[nodiscard]] bool clean() const { return repeated == 0 && backward == 0 && missing == 0; }
    /// One line for people.
    [[nodiscard]] std::string text() const;
};

/// Makes the stamps rise. Samples stamped before the latest stamp are left out. Of samples with one stamp the mean
/// output and the last input stay; but where half of all stamps or more repeat and the samples of one stamp differ, a
/// logger stamped what it received in bursts, and the samples are spread evenly to the next stamp (drive/bursts.hpp). A
/// gap is an interval beyond 1.75 usual ones; it is reported and stays. \throws glsum::Failure (bad input) if fewer
/// than 2 samples are left, or more than a tenth ran backward.
StampReport order_stamps(Log& log);

enum class Hold { linear, zero_order };

/// Where a constant rate ends: with the last step within the log, or with the first that is not before its last stamp.
enum class End { within, behind };

struct Resampled {
    Log log;
    StampReport stamps;
};

/// A log at a constant rate, from its first stamp to its last: t_k = t_0 + k step_s. Linear interpolation, or the value
/// of the latest sample; inputs are always held, as they were applied. \throws glsum::Failure (bad input) as
/// `order_stamps`, and for a step that is not above 0 or gives more than `LogLimits::samples`.
[[nodiscard]] Resampled resample(Log log, double step_s, Hold hold, End end = End::within);

/// CSV with columns time_s, input (if there is one), input_2 and further ones, output and simulated (if there are), in
/// shortest numbers that read back exactly.
[[nodiscard]] std::string to_csv(const Log& log, const std::string& output_name = "output");

}  // namespace drive
