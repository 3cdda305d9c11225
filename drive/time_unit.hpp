// Units of stamps as loggers write them: in the column's name (`t_ms`, `time [ms]`), or in a row of units below it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace drive {

struct TimeUnit {
    const char* symbol = "s";      ///< as options name it
    const char* name = "seconds";  ///< for people
    double of_seconds = 1.0;       ///< s in it, or 1
    double per_second = 1.0;       ///< of them in a second, or 1

    /// In s. A quotient, so that 0.01 s stay what they are.
    [[nodiscard]] double seconds(double value) const { return value * of_seconds / per_second; }
    friend bool operator==(const TimeUnit& a, const TimeUnit& b) {
        return a.of_seconds == b.of_seconds && a.per_second == b.per_second;
    }
};

/// ns, us, ms, s, min or h, or one of their usual names, in any case, also between brackets.
[[nodiscard]] std::optional<TimeUnit> time_unit_of(std::string_view word);

/// A column's name in its two parts: what stands before a unit in brackets, and the unit, which may be any.
struct NameWithUnit {
    std::string base;  ///< the name itself where there are no brackets
    std::string unit;
};
[[nodiscard]] NameWithUnit split_unit(std::string_view name);

/// The same for a column of stamps: the unit may also stand behind `_`, `/` or a blank; it is one of time.
struct TimeName {
    std::string base;
    std::optional<TimeUnit> unit;
};
[[nodiscard]] TimeName split_time_unit(std::string_view name);

/// In small letters.
[[nodiscard]] std::string lower(std::string_view text);

}  // namespace drive
