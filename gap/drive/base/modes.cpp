#include "gap/drive/base/modes.hpp"

#include <algorithm>
#include <complex>
#include <limits>
#include <string_view>

#include "drive/stability.hpp"
#include "gap/drive/study.hpp"

namespace gap {
namespace {

bool is_two_modes(const Described& one) { return std::string_view(one.name) == "two_modes"; }

// How long the slowest pole takes to 1/e, in s; infinite where one does not die away.
double decay_s(const drive::Form& form) {
    double least_per_s = std::numeric_limits<double>::infinity();
    for (const std::complex<double>& pole : drive::judge_stability(model_of(form), 1.0).poles) {
        least_per_s = std::min(least_per_s, -pole.real());
    }
    return least_per_s > 0.0 ? 1.0 / least_per_s : std::numeric_limits<double>::infinity();
}

}  // namespace

void keep_own_modes(std::vector<Described>& found, double longest_s) {
    // Many numbers follow any bend a little way; a second mode that is there takes most.
    constexpr double most_left = 0.5;
    constexpr double of_record = 1.0 / 3.0;
    double aside = std::numeric_limits<double>::infinity();
    double validation = std::numeric_limits<double>::infinity();
    for (const Described& one : found) {
        if (!is_two_modes(one)) {
            aside = std::min(aside, one.aside);
            validation = std::min(validation, one.validation);
        }
    }
    std::erase_if(found, [&](const Described& one) {
        return is_two_modes(one) && !(one.aside < most_left * aside && one.validation < most_left * validation &&
                                      decay_s(one.form) < of_record * longest_s);
    });
}

}  // namespace gap
