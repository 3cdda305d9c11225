// Blind cases: logs of plants with an effect that only a sealed file names.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drive/stand/blind/effects.hpp"
#include "drive/stand/blind/profile.hpp"

namespace stand::blind {

/// What the right answer is.
enum class Class {
    none,      ///< `no_gap`
    single,    ///< the one effect
    pair,      ///< both effects together
    unlisted,  ///< `unknown`
    same,      ///< cannot be told from others by construction: `ambiguous`, with the right alternatives
    taken_up,  ///< without a model: what a fitted base takes up by itself, `no_gap`
};
[[nodiscard]] const char* name_of(Class kind);

/// What is asked of a case, before chance fills it in.
struct Plan {
    Class kind = Class::none;
    std::vector<std::string> effects;
    std::vector<EffectSize> sizes;
    bool new_profile = false;  ///< validation goes where training never was
};

/// `count` of them: a quarter without an effect (and of those half on a new profile), 15 % with an unlisted one, 15 %
/// with two, 8 % that are the same as others by construction, the rest with one; effects and sizes dealt like cards.
[[nodiscard]] std::vector<Plan> plan_cases(std::size_t count, std::uint64_t seed);

struct Truth {
    Plan plan;
    std::vector<Parameters> parameters;  ///< of each effect; of events, those of the validation record
    std::vector<std::string> required;   ///< of `same`: what the alternatives must name, the truth included
    std::vector<std::string> allowed;    ///< and what else they may
    std::string plant;                   ///< `stand`, `whole` or `fractional`
    std::string train;
    std::string validate;
    bool coloured = false;
    double noise = 0.0;            ///< standard deviation, output units
    double train_deviation = 0.0;  ///< rms of what the effect changes, over the noise's
    double validate_deviation = 0.0;
    double gap_base = 0.0;     ///< rms(measured - simulated without the effect) over the deviation of the measured
    double noise_floor = 0.0;  ///< the same of the noise alone
    double from_s = 0.0;       ///< an event's place in the validation record
    double to_s = 0.0;
};

struct Case {
    std::string model;  ///< JSON
    std::string train;  ///< CSV
    std::string validate;
    Truth truth;
};

/// The same seed, number and plan give the same case. \param number  from 1
[[nodiscard]] Case make_case(const Plan& plan, std::uint64_t seed, std::size_t number);

/// `001`, `002`, ...: the name of a case's folder.
[[nodiscard]] std::string name_of_case(std::size_t number);

/// The truth of all cases, as the sealed file holds it.
[[nodiscard]] std::string seal(std::uint64_t seed, const std::vector<Truth>& truths);

/// Cases of a seed, in order. \param done  called after each
[[nodiscard]] std::vector<Case> make_cases(std::size_t count, std::uint64_t seed, unsigned jobs,
                                           const std::function<void()>& done = {});

}  // namespace stand::blind
