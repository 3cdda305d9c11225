// An answer beside the base that the records have by themselves.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gap/drive/answer.hpp"

namespace gap {

/// The search is done beside each base that is worth it; what leaves least, at a price for each number, is the answer.
/// \param question  without a form \throws glsum::Failure (bad input): nothing explains anything
[[nodiscard]] Answer answer_beside_found_base(Question question, const std::function<void(const std::string&)>& say);

/// Whether no further base is asked: nothing is missing. Of a disturbance another base may still know what it is.
[[nodiscard]] bool is_settled(const Decision& decision);

/// Whether the best base leaves more than half of the output: the sensor may have lost its sign.
[[nodiscard]] bool leaves_most(const Described& base);
/// Whether one that is found with signs is believed, since it leaves less than half as much. Both in the output's unit.
[[nodiscard]] bool leaves_half_of(double with_signs, double without);

/// Answer::linear_share, where the base that was asked beside has its own.
[[nodiscard]] double best_linear_share(double of_base, const std::vector<Described>& found);

/// A base with what was found beside it, and what that is worth.
struct BesideABase {
    std::string name;
    Answer answer;
    double price;
};

/// The logarithm of the gap that stays, and a price for each number, of an event in each record that judges.
[[nodiscard]] double price_of(const Answer& answer, int base_numbers);

/// The one that costs least, less sure where another one with other causes costs about as little.
/// \pre not empty
[[nodiscard]] Answer cheapest_of(std::vector<BesideABase> tried);

/// What the best base does as well when it sees the validation, too, is none of the drive's effects: no gap. Of a form
/// that was asked for it may be the form's own misfit, as well in one record as in two.
/// \param jointly  the gap of the base that is fitted to all records
void judge_jointly(Answer& answer, double jointly);

}  // namespace gap
