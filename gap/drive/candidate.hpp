// A base model with some effects and the numbers that it has.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gap/drive/study.hpp"

namespace gap {

/// One number that a fit may move.
struct FreeParameter {
    std::string name;  ///< "gain", "input_dead_zone.width", "initial_output"
    double value;
    double lower;
    double upper;
    double scale;  ///< what counts as a step: differences are taken over 3e-4 of it
    bool fixed = false;
    double deviation = 0.0;      ///< of a fitted value, by `add_deviations`; infinite if nothing tells it
    bool moves_nothing = false;  ///< found by `add_deviations`: close by, no residual depends on it
    double low = 0.0;            ///< 95 % interval, by `add_intervals`
    double high = 0.0;
    std::string unit = {};  ///< of an effect's number, in those of input u and output y; empty: another's
};

[[nodiscard]] std::vector<double> values_of(const std::vector<FreeParameter>& numbers);

struct Candidate {
    std::vector<const Effect*> effects;
    std::vector<FreeParameter> base;                  ///< shared by all records
    std::vector<std::vector<FreeParameter>> lasting;  ///< by effect
    std::vector<std::vector<FreeParameter>> own;      ///< by record: its state, then what it has of effects for itself
    double cost = 0.0;                                ///< half the sum of squares of the (whitened) residuals
    [[nodiscard]] std::string name() const;           ///< "none", or effects joined by " + "
    [[nodiscard]] bool has(const std::string& effect) const;
    /// A lasting effect's numbers; null: it has no such effect.
    [[nodiscard]] const std::vector<FreeParameter>* numbers_of(const Effect* effect) const;
    /// What one of its effects is with the numbers that it has (Effect::is_only).
    [[nodiscard]] std::optional<Special> only(const Effect* effect) const;
    /// Whether one of its effects is so: `candidate.any(&Effect::rounds)`.
    [[nodiscard]] bool any(bool Effect::*trait) const;
    [[nodiscard]] bool has_events() const;
    [[nodiscard]] std::size_t effect_parameters() const;  ///< free ones of effects, those of events in one record
    [[nodiscard]] std::size_t event_parameters() const;   ///< free ones, in all records
    /// Free ones of effects, those of events in each record: what events explain is fitted wherever it is judged.
    [[nodiscard]] std::size_t effect_parameters_in_all() const;
};

/// The base's free numbers at their starts; none unless it is refitted.
[[nodiscard]] std::vector<FreeParameter> base_of(const Study& study);
/// The form with the numbers that a candidate has of it.
[[nodiscard]] drive::Form with_values(const drive::Form& form, const Candidate& candidate);
/// A record's own state likewise.
[[nodiscard]] std::vector<FreeParameter> state_of(const Study& study, const Record& record);
/// An effect's parameters at one of its starts; what each record has for itself is fixed.
[[nodiscard]] std::vector<FreeParameter> parameters_of(const Effect& effect, const Scales& scales, std::size_t start);
/// What a record has of an effect for itself: all of an event, of a lasting one what is so (EffectParameter).
[[nodiscard]] std::vector<FreeParameter> own_parameters_of(const Effect& effect, const Scales& scales);
[[nodiscard]] std::size_t starts_of(const Effect& effect, const Scales& scales);
[[nodiscard]] bool applies(const Effect& effect, const Scales& scales);

/// The numbers that are not fixed: base, lasting and own in turn, or own alone.
[[nodiscard]] std::vector<FreeParameter*> free_numbers(Candidate& candidate, bool own_only);

[[nodiscard]] Scenario scenario_of(const Study& study, const Candidate& candidate, std::size_t record);
/// measured - simulated, or - predicted over the study's horizon
[[nodiscard]] std::vector<double> residuals_of(const Study& study, const Candidate& candidate, std::size_t record);
/// Of every record.
[[nodiscard]] std::vector<std::vector<double>> all_residuals(const Study& study, const Candidate& candidate);

}  // namespace gap
