// The base that records have by themselves: the linear description, whole or fractional, that does best where it was
// not fitted.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gap/drive/question.hpp"

namespace gap {

struct Structure;

/// How far one description goes.
struct Described {
    std::string name;
    std::string meaning;
    drive::Form form;   ///< with its fitted values
    double aside;       ///< rms of what it leaves over the output's deviation, in blocks of the training kept aside
    double validation;  ///< and on the validation
    int numbers;
    int integrators;
    bool from_no_input = false;  ///< Base::from_no_input
};

/// In the place of a form that is still to be found.
[[nodiscard]] drive::Form form_to_find();

/// Of some filters, dead times and even lags.
struct Starts {
    drive::Form whole;  ///< whose simulation, with gain, offset and initial state by least squares, leaves least
    std::vector<drive::Form> elsewhere;  ///< that leave little more with other lags, where there are three or a zero
    std::optional<drive::Form> quick;    ///< that leaves clearly less of what is quick, where there is one
    double quick_s;                      ///< what is older is not quick
};
/// \throws glsum::Failure (bad input): nothing explains anything
[[nodiscard]] Starts starts_of(const Structure& structure, const std::vector<Record>& records);

/// All structures that can be fitted, by how far they go where they were not, the base first (`keep_in_order`).
/// \param question  without a form \throws glsum::Failure (bad input): nothing explains anything
[[nodiscard]] std::vector<Described> find_base(const Question& question,
                                               const std::function<void(const std::string&)>& say);

}  // namespace gap
