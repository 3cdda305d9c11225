#include "gap/drive/determined.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gap/drive/deviations.hpp"
#include "gap/drive/ranking.hpp"

namespace gap {
namespace {

constexpr double quantile = 1.96;  // of a normal deviation: 95 %
constexpr double likely = 2.0;     // units of likelihood: 95 %
constexpr int tries = 16;          // of a range, on each side

constexpr double anywhere = 4.0;  // deviations: of noise, too, the best of all times or candidates is some

double half_squares(const Study& study, const Candidate& candidate, const Whitener* whitener) {
    double sum = 0.0;
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        std::vector<double> residuals = residuals_of(study, candidate, r);
        residuals = whitener != nullptr ? whitener->apply(residuals) : residuals;
        for (std::size_t i = 0; i < residuals.size(); ++i) {
            sum += study.counts[r][i] != 0 ? 0.5 * residuals[i] * residuals[i] : 0.0;
        }
    }
    return sum;
}

// How many of the counted samples tell anything new.
double samples_new(const Study& study, const Candidate& candidate) {
    double samples = 0.0;
    for (const auto& count : study.counts) {
        samples += static_cast<double>(std::count(count.begin(), count.end(), 1));
    }
    constexpr double blocks = 24.0;
    return std::max(blocks, samples / whitener_of(study, candidate).samples_apart);
}

// The farthest value towards `bound` that is as likely.
double as_far_as_likely(const Study& study, Candidate& candidate, FreeParameter& parameter, const Whitener* whitener,
                        double bound) {
    const double value = parameter.value;
    const double best = half_squares(study, candidate, whitener);
    const double enough = samples_new(study, candidate);
    double far = value;
    for (int step = 1; step <= tries; ++step) {
        const double tried = value + (bound - value) * step / tries;
        parameter.value = tried;
        const double rises = 0.5 * enough * std::log(half_squares(study, candidate, whitener) / best);
        parameter.value = value;
        if (!(rises < likely)) {
            break;
        }
        far = tried;
    }
    return far;
}

// Whether the scenario is the same with the number at none as without the effect.
bool takes_away(const Study& study, const Candidate& candidate, std::size_t effect, std::size_t lasting,
                std::size_t number, double none) {
    Candidate at_none = candidate;
    at_none.lasting[lasting][number].value = none;
    Candidate without = candidate;
    without.effects.erase(without.effects.begin() + static_cast<std::ptrdiff_t>(effect));
    without.lasting.erase(without.lasting.begin() + static_cast<std::ptrdiff_t>(lasting));
    const std::vector<double> a = residuals_of(study, at_none, 0);
    const std::vector<double> b = residuals_of(study, without, 0);
    const double same = 1e-3 * std::max(study.noise, study.least_deviation);
    return std::equal(a.begin(), a.end(), b.begin(), [&](double x, double y) { return std::fabs(x - y) < same; });
}

// A width found by likelihood has a deviation from there, and moves no residual. One at the end of its range, an
// interval, would have samples change places.
bool is_spread_told(const FreeParameter& width, double none) {
    constexpr double at_the_end = 0.95;
    return width.value - quantile * width.deviation > none && width.value < at_the_end * width.upper;
}

bool holds(const FreeParameter& parameter, double value) { return parameter.low <= value && value <= parameter.high; }

// Whether chance, which has some hundred candidates to go by beside a fitted form, leaves a number as far from none.
bool is_by_chance(const Study& study, const FreeParameter& parameter, double none) {
    return study.base.refit && !parameter.moves_nothing &&
           !(std::fabs(parameter.value - none) > anywhere * parameter.deviation);
}

}  // namespace

void add_intervals(const Study& study, Candidate& candidate, const Whitener* whitener) {
    add_deviations(study, candidate, whitener);
    const std::vector<FreeParameter*> free = free_numbers(candidate, false);
    for (FreeParameter* parameter : free) {
        const double far = quantile * parameter->deviation;
        parameter->low = std::max(parameter->lower, parameter->value - far);
        parameter->high = std::min(parameter->upper, parameter->value + far);
    }
    for (FreeParameter* parameter : free) {
        if (parameter->moves_nothing && parameter->name.find('.') != std::string::npos) {
            parameter->low = as_far_as_likely(study, candidate, *parameter, whitener, parameter->lower);
            parameter->high = as_far_as_likely(study, candidate, *parameter, whitener, parameter->upper);
        }
    }
}

std::string untold_of(const Study& study, const Candidate& candidate,
                      const std::function<bool(const Effect&)>& needed) {
    std::size_t lasting = 0;
    for (std::size_t e = 0; e < candidate.effects.size(); ++e) {
        const Effect& effect = *candidate.effects[e];
        if (effect.kind != Kind::lasting) {
            continue;
        }
        const std::vector<EffectParameter> named = effect.parameters(study.scales);
        const std::vector<FreeParameter>& numbers = candidate.lasting[lasting];
        if (effect.only_spreads && !is_spread_told(numbers.front(), named.front().none)) {
            return fmt::format("training leaves {} anywhere up to {:.4g}, where {:.4g} is no effect",
                               numbers.front().name, numbers.front().upper, named.front().none);
        }
        std::vector<std::size_t> free;
        std::vector<std::size_t> strengths;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (!numbers[i].fixed) {
                free.push_back(i);
                if (takes_away(study, candidate, e, lasting, i, named[i].none)) {
                    strengths.push_back(i);
                }
            }
        }
        ++lasting;
        const std::vector<std::size_t>& asked = strengths.empty() ? free : strengths;
        const bool told =
            asked.empty() || std::any_of(asked.begin(), asked.end(), [&](std::size_t i) {
                return !holds(numbers[i], named[i].none) && !is_by_chance(study, numbers[i], named[i].none);
            });
        if (!told && !(needed && needed(effect))) {
            const FreeParameter& first = numbers[asked.front()];
            const double none = named[asked.front()].none;
            return fmt::format(
                "training leaves {} anywhere between {:.4g} and {:.4g}, {}", first.name, first.low, first.high,
                holds(first, none) ? fmt::format("where {:.4g} is no effect", none)
                                   : "and of so many candidates some are as far from no effect by chance");
        }
    }
    return "";
}

bool leaves_open(const Study& study, const Candidate& candidate) {
    constexpr double a_part = 0.05;
    // What a record shows by itself, its level at rest, say, takes up nothing.
    constexpr double shown = 0.05;
    Candidate copy = candidate;
    for (FreeParameter* number : free_numbers(copy, false)) {
        number->fixed = number->upper - number->lower < shown * number->scale;
    }
    // A hundredth of what the best told direction does: where friction takes over at rest parts two levels from their
    // mean and a force, too, and hardly.
    constexpr double hardly = 1e-4;
    const std::vector<double> shares = untold_shares(study, copy, hardly);
    auto share = shares.begin();
    for (const FreeParameter* number : free_numbers(copy, false)) {
        const bool of_effect = number->name.find('.') != std::string::npos;
        if (*share++ > a_part && of_effect) {
            return true;
        }
    }
    return false;
}

std::string linear_of(const Study& study, const Candidate& candidate) {
    std::size_t lasting = 0;
    for (const Effect* effect : candidate.effects) {
        if (effect->kind != Kind::lasting) {
            continue;
        }
        std::vector<Fitted> fitted;
        for (const FreeParameter& number : candidate.lasting[lasting++]) {
            fitted.push_back({number.value, number.low, number.high});
        }
        const std::string why = effect->linear_with != nullptr ? effect->linear_with(fitted, study.scales) : "";
        if (!why.empty()) {
            return fmt::format("{}: {}", effect->name, why);
        }
    }
    return "";
}

bool needs_event(const Study& study, const std::vector<FreeParameter>& own, const Effect& effect, double least_size) {
    const std::vector<EffectParameter> named = effect.parameters(study.scales);
    return std::any_of(named.begin(), named.end(), [&](const EffectParameter& parameter) {
        const auto mine = std::find_if(own.begin(), own.end(), [&](const FreeParameter& free) {
            return free.name == effect.name + "." + parameter.name;
        });
        return parameter.name.starts_with("size") && mine != own.end() && std::fabs(mine->value) >= least_size &&
               std::fabs(mine->value - parameter.none) > anywhere * mine->deviation;
    });
}

}  // namespace gap
