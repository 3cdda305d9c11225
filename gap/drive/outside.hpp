// Whether an event that was found comes from outside, as its effect says: what begins with the input, record after
// record, or lasts from its first move to the end, or undoes the input, is something that the drive does itself; what
// is there before the input can act is the past.
#pragma once

#include <optional>
#include <string>

#include "gap/drive/candidate.hpp"

namespace gap {

/// A record's event, in seconds from its first stamp.
struct Happening {
    double from_s;
    std::optional<double> to_s;  ///< of a disturbance
};

/// How large an event has to be to be one: a twentieth of the largest of all records. A smaller one follows what the
/// base leaves in its record.
[[nodiscard]] double least_felt(const Effect& effect, const Candidate& trained, const Candidate& validated);

/// By which chance a time drawn at random lies as near to a large move of the input, a dead time later, as this one.
/// 1: the input never moves at once, or always.
[[nodiscard]] double chance_of_meeting(const Record& record, double time_s, double delay_s);

/// Of several such chances, by which they come out as small together, by Fisher's method.
[[nodiscard]] double joint_chance(std::span<const double> chances);

/// Whether it begins within `settling_s` of the input's first move, or before, and is still there at the record's end.
[[nodiscard]] bool lasts_throughout(const Record& record, const Happening& happening, double settling_s);

/// Whether it begins in the dead time of a record that begins in motion. Its start is fitted as a value and a speed;
/// the past of a plant, above all of one whose orders are not whole, is more, and a force follows what these leave.
/// \param own  the record's numbers
[[nodiscard]] bool acts_before_the_input(const std::vector<FreeParameter>& own, const Happening& happening,
                                         double delay_s);

/// Whether a force undoes the input, to a twentieth of it, which stays where it is as long as the force lasts: a drive
/// that does not act does, one that has yet to start, say. \param size  in units of the model's right-hand side
[[nodiscard]] bool undoes_the_input(const Record& record, const drive::Model& model, const Happening& happening,
                                    double size);

/// What speaks against the events of a candidate being such, for a note; empty: nothing, or it has none.
[[nodiscard]] std::string doubt_of_events(const Study& study, const Candidate& trained, const Study& validation,
                                          const Candidate& validated);

}  // namespace gap
