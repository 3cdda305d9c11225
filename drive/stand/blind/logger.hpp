// What a logger makes of a record: it starts late, rounds, repeats stamps, leaves rows out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drive/stand/blind/profile.hpp"

namespace stand::blind {

struct Logger {
    std::string input;   ///< column
    std::string output;  ///< column
    double stamp_step_s = 1e-6;
    double output_step = 1e-9;    ///< readings are multiples of it
    double input_jump = 0.0;      ///< a row whose input moved by more than this is never left out
    double repeated_share = 0.0;  ///< of rows that are written twice
    double missing_share = 0.0;   ///< of rows that are not written, one to four in a row
    bool own_clock = false;       ///< stamps begin at 0, whenever it started
};

/// The stamp that the logger writes for a time. \param first_s  the time of its first row
[[nodiscard]] double stamp_of(const Logger& logger, double time_s, double first_s);

/// CSV with columns time_s, input and output. \param from  the first sample that it sees
[[nodiscard]] std::string write_log(const Logger& logger, const Held& held, const std::vector<double>& readings,
                                    std::size_t from, Chance& chance);

}  // namespace stand::blind
