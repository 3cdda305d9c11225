// What is known of an exam's rigs, sealed until the answers are hashed.
//
//   {"schema": "glsum-exam-truth-1", "questions": [
//     {"name": "arm", "known": "listed", "causes": [{"any_of": ["gravity_nonlinearity"]},
//      {"any_of": ["coulomb_friction", "direction_dependent_friction"], "main": false}],
//      "attainable_gap": 0.05, "source": "its authors"}]}
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gap::exam {

enum class Known {
    listed,      ///< effects of the list make the gap
    nothing,     ///< a fitted base leaves nothing large
    not_listed,  ///< something makes it that is on no list, or cannot be known from what was logged
};

/// A cause under each name that says the same of these records.
struct Cause {
    std::vector<std::string> any_of;
    bool main = true;  ///< it makes much of the gap; what is not, is true and need not be named
};

struct Truth {
    std::string name;
    Known known = Known::listed;
    /// At least a main one where listed; else what may be named all the same.
    std::vector<Cause> causes;
    std::optional<double> attainable_gap;      ///< what is left at best
    std::optional<double> attainable_of_base;  ///< the same in parts of the base's gap
    std::string source;                        ///< who knows it; may be empty
};

/// \throws glsum::Failure (bad input) naming the file, the line or the question, what was expected and what was found.
[[nodiscard]] std::vector<Truth> parse_truth(const std::string& text, const std::string& name);

}  // namespace gap::exam
