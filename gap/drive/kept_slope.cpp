#include "gap/drive/kept_slope.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace gap {
namespace {

double mean_output(const Study& study) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Course& course : study.courses) {
        const std::vector<double>& output = course.record().output;
        sum = std::accumulate(output.begin(), output.end(), sum);
        count += output.size();
    }
    return sum / static_cast<double>(count);
}

// Over the restoring term's coefficient, which is 1, are the gain and every lag; orders, a zero and a dead time are
// not.
bool is_over_stiffness(const std::string& name) {
    return name == "gain" || name == "time_constant_s" ||
           (name[0] == 'a' && std::isdigit(static_cast<unsigned char>(name[1])) != 0);
}

}  // namespace

std::optional<Candidate> with_slope_kept(const Study& study, const Candidate& candidate, const Candidate& start) {
    double slope = 1.0;
    for (const Effect* effect : candidate.effects) {
        const std::vector<FreeParameter>* numbers = candidate.numbers_of(effect);
        if (numbers != nullptr && effect->slope != nullptr && start.numbers_of(effect) == nullptr) {
            slope += effect->slope(values_of(*numbers), mean_output(study));
        }
    }
    // A form whose stiffness is a number of its own gives way by that alone.
    const bool own_stiffness =
        std::ranges::any_of(candidate.base, [](const FreeParameter& number) { return number.name == "a0"; });
    if (!study.base.refit || slope == 1.0 || own_stiffness) {
        return std::nullopt;
    }
    Candidate kept = candidate;
    for (FreeParameter& number : kept.base) {
        if (is_over_stiffness(number.name)) {
            number.value = std::clamp(slope * number.value, number.lower, number.upper);
        }
    }
    return kept;
}

std::optional<Candidate> counted_from_zero(const Study& study, const Candidate& candidate, const Candidate& start) {
    const bool counts = std::ranges::any_of(candidate.effects, [&](const Effect* effect) {
        const std::vector<FreeParameter>* numbers = candidate.numbers_of(effect);
        return numbers != nullptr && effect->from_zero != nullptr && effect->from_zero(values_of(*numbers)) &&
               start.numbers_of(effect) == nullptr;
    });
    if (!study.base.refit || !counts) {
        return std::nullopt;
    }
    Candidate counted = candidate;
    double offset = 0.0;
    for (auto& own : counted.own) {
        for (FreeParameter& number : own) {
            if (number.name == "offset") {
                offset += number.value / static_cast<double>(counted.own.size());
                number.value = std::clamp(0.0, number.lower, number.upper);
            }
        }
    }
    const double mean = mean_output(study);
    const double share = mean / (mean - offset);
    if (offset == 0.0 || !(share > 0.0)) {
        return std::nullopt;
    }
    for (FreeParameter& number : counted.base) {
        if (number.name == "gain") {
            number.value = std::clamp(share * number.value, number.lower, number.upper);
        }
    }
    return counted;
}

}  // namespace gap
