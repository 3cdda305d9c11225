// Stamps of a log in seconds: numbers in any unit, dates as in ISO 8601, or seconds, milliseconds, ... since 1970.
// Dates and times since 1970 count from the first stamp, which is exact where the whole number would not fit a double.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drive/decimals.hpp"
#include "drive/time_unit.hpp"

namespace drive {

/// A time in two parts, so that no digit of it is lost.
struct Instant {
    std::int64_t whole = 0;
    double part = 0.0;        ///< of one, 0 to 1
    bool has_offset = false;  ///< of a date: it said its offset from UTC
};

/// `2024-05-01T12:00:00.123Z`: also with a blank for the T, a comma for the point, without seconds, with an offset as
/// +02:00, +0200 or +02, or with none. \return s since 1970, UTC, or nothing if it is no date
[[nodiscard]] std::optional<Instant> date_of(std::string_view text);
[[nodiscard]] bool looks_like_date(std::string_view text);

class Stamps {
public:
    /// What is known of the column before its first stamp.
    struct Column {
        std::string name;
        std::string unit_below = {};      ///< in the row of units; empty: there is none
        std::string unit_by_option = {};  ///< ns, us, ms, s, min or h; empty: as the file shows
    };
    /// \param file  for messages; outlives this, as `decimals` does
    /// \throws glsum::Failure (bad input): an option that is no unit; units that contradict each other
    Stamps(const std::string& file, Decimals& decimals, Column column);

    /// In s. \throws glsum::Failure (bad input) naming file, line and column: neither a finite number nor a date, or
    /// another kind than the first stamp
    double read(std::string_view field, std::size_t line);

    /// What was found beyond seconds, for people; empty if nothing.
    [[nodiscard]] std::string found() const;

private:
    enum class Kind { unknown, number, since_1970, date };

    void begin(std::string_view field, std::size_t line);

    const std::string& file_;
    Decimals& decimals_;
    Column column_;
    std::optional<TimeUnit> unit_;  ///< that was named
    bool unit_by_size_ = false;
    Kind kind_ = Kind::unknown;
    Instant first_;
};

}  // namespace drive
