// Whether records can judge what others were fitted to.
#pragma once

#include <string>
#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

/// \param asked  how the split was asked for, which begins the message
/// \throws glsum::Failure (bad input): fewer than 32 samples of a record on a side of the split
void check_split(const std::string& asked, double split_s, const std::vector<Record>& records);

/// \throws glsum::Failure (bad input): a record that judges is one of those that are fitted
void check_unseen(const std::vector<Record>& train, const std::vector<Record>& validate);

}  // namespace gap
