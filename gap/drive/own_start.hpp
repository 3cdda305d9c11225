// What a record has of a lasting effect for itself: where a wave stands, say, when the record begins.
#pragma once

#include "gap/drive/candidate.hpp"

namespace gap {

/// Such numbers at the best of their starts in each record, if that goes further than where they are. All else stays.
void begin_own(const Study& study, Candidate& candidate);

/// That of all records, which files are told, as the first one has it.
void take_first_records(Candidate& candidate);

}  // namespace gap
