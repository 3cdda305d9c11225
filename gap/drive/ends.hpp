// Readings at an end: of the sensor, which holds them noise and all, or of what comes before it, where the input goes
// further and the readings stay. Neither tells of the plant but that it is beyond.
#pragma once

#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

/// By sample: whether it is one of a stretch that stays at the record's highest or lowest reading while the input goes
/// further that way, by a twentieth of its range or more. It stays within a fiftieth of the readings' swing, or eight
/// times their noise if that is more. A linear plant would follow; its dead time, a thirtieth of the record, is no such
/// stretch. None where eight times the noise reach a tenth of the swing.
[[nodiscard]] std::vector<char> readings_at_an_end(const Record& record);

/// What counts, less what is clipped or at an end; of a record that would be left without fifty samples all that
/// counted.
[[nodiscard]] std::vector<std::vector<char>> without_ends(std::vector<std::vector<char>> counts,
                                                          const std::vector<Record>& records);

}  // namespace gap
