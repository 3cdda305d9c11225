// Blind cases of which nobody hands over a model: logs of a mechanical, a thermal or a hydraulic plant, and its domain.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/family.hpp"

namespace stand::blind {

/// What a linear base must leave of an effect, over the noise: on validation, and in training, where else nothing
/// would determine its size.
inline constexpr double least_left_on_validation = 5.0;
inline constexpr double least_left_in_training = 3.0;

struct OpenPlan {
    const Family* family = nullptr;
    Plan plan;
};

/// `count` of them, an equal number of each family: 12 % without anything, 13 % with what a fitted base takes up, 15 %
/// with an unlisted effect, 12 % with two, the rest with one. \throws glsum::Failure (bad input) outside 1 to 999.
[[nodiscard]] std::vector<OpenPlan> plan_open_cases(std::size_t count, std::uint64_t seed);

struct OpenTruth {
    std::string domain;
    Plan plan;
    std::vector<Parameters> parameters;  ///< of events, those of the first validation record
    std::string plant;
    std::vector<std::string> train;  ///< excitations
    std::vector<std::string> validate;
    double noise = 0.0;  ///< standard deviation, output units
    bool coloured = false;
    double left_in_training = 0.0;  ///< of the effects, what a refitted linear base does not take up, over the noise
    double left_on_validation = 0.0;
    double gap_base = 0.0;  ///< of that base, over the deviation of the first validation record
    double noise_floor = 0.0;
    double from_s = 0.0;  ///< an event's place in the first validation record, by its stamps
    double to_s = 0.0;
};

struct OpenCase {
    std::string facts;                                         ///< JSON, schema `glsum-case-1`: what the judge is told
    std::vector<std::pair<std::string, std::string>> records;  ///< file name, CSV
    OpenTruth truth;
};

/// An event begins 15 to 60 % into its record; a disturbance lasts for 10 to 25 % of it. \param first_s  stamp
void place_event(Fault& event, double first_s, double length_s, Chance& chance);

/// The same seed, number and plan give the same case. Where the effect shows in no plant of the family another of the
/// same list takes its place: of six effects each is given forty plants. \param number  from 1 \throws glsum::Failure
/// (check failed) where none does.
[[nodiscard]] OpenCase make_open_case(const OpenPlan& plan, std::uint64_t seed, std::size_t number);

/// Cases of a seed, in order. \param done  called after each
[[nodiscard]] std::vector<OpenCase> make_open_cases(std::size_t count, std::uint64_t seed, unsigned jobs,
                                                    const std::function<void()>& done = {});

/// The truth of all cases, as the sealed file holds it: schema `glsum-blind-truth-1` with `"base": "fitted"`.
[[nodiscard]] std::string seal_open(std::uint64_t seed, const std::vector<OpenTruth>& truths);

}  // namespace stand::blind
