// Two modes in a base: the plant's own, or a wave from outside that an oscillator without damping draws by itself.
#pragma once

#include <vector>

#include "gap/drive/base/find.hpp"

namespace gap {

/// Takes two modes off the list unless they leave less than half of what the best other description leaves, in the
/// blocks kept aside and on the validation, and die away within a third of the longest record.
void keep_own_modes(std::vector<Described>& found, double longest_s);

}  // namespace gap
