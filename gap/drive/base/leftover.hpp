// What a linear model leaves of records once all that is linear in it suits them best.
#pragma once

#include <limits>
#include <vector>

#include "gap/drive/simulate.hpp"

namespace gap {

struct Leftover {
    double squares = std::numeric_limits<double>::infinity();  ///< of the readings; infinite: it runs away
    double gain = 1.0;                                         ///< the best
};

/// What is left as it is, and of what is quick.
struct Leftovers {
    Leftover whole;
    Leftover quick;
};

/// Gain, and of each record offset, initial output, initial speed and, where the model integrates, a constant force, by
/// linear least squares. \param model  of gain 1 \param driven  false: the input is 0, and the gain stays
[[nodiscard]] Leftover leftover_of(const drive::Model& model, const std::vector<Course>& courses, bool driven);

/// The same, and of the readings less their mean over the last `quick_s`. What is bent seems slow: a staircase up a
/// curve is a long lag's ramp, and only its steps tell how quick it is.
[[nodiscard]] Leftovers leftovers_of(const drive::Model& model, const std::vector<Course>& courses, bool driven,
                                     double quick_s);

}  // namespace gap
