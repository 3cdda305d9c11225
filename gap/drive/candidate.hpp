// A base model with some effects, fitted to records.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "drive/fit.hpp"
#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"
#include "gap/whiten.hpp"

namespace gap {

/// What of the base may move: nothing when a given model is judged as it is; everything when it is refitted.
struct Base {
    drive::Form form;            ///< of the model, with its start values
    bool refit = false;          ///< the form's free parameters are fitted
    bool initial_state = false;  ///< offset, initial output and velocity of each record are fitted
};

/// One number that a fit may move.
struct FreeParameter {
    std::string name;  ///< "gain", "input_dead_zone.width", "record 1: initial_output"
    double value;
    double lower;
    double upper;
    double scale;  ///< what counts as a step: differences are taken over 3e-4 of it
    double deviation =
        0.0;  ///< standard deviation of a fitted value, by `add_deviations`; infinite if nothing tells it
};

struct Candidate {
    std::vector<const Effect*> effects;
    std::vector<FreeParameter> base;                  ///< shared by all records
    std::vector<std::vector<FreeParameter>> lasting;  ///< by effect
    std::vector<std::vector<FreeParameter>> own;      ///< by record: initial state, then events' parameters
    double cost = 0.0;                                ///< half the sum of squares of the (whitened) residuals
    Eigen::MatrixXd covariance;                       ///< of base, lasting, own in turn; empty until asked for
    [[nodiscard]] std::string name() const;           ///< "none", or effects joined by " + "
    [[nodiscard]] std::size_t parameter_count() const;
};

/// Records with everything that fits over them share.
struct Study {
    Base base;
    Scales scales;
    std::vector<Course> courses;
    std::vector<std::vector<char>>
        counts;              ///< by record and sample: whether it counts here; a split record's other part does not
    double least_deviation;  ///< of readings: what their quantum leaves
};

[[nodiscard]] Scenario scenario_of(const Study& study, const Candidate& candidate, std::size_t record);
/// measured - simulated
[[nodiscard]] std::vector<double> residuals_of(const Study& study, const Candidate& candidate, std::size_t record);

/// Fits base, effects and each record's own numbers by bounded least squares on residuals whitened by `whitener` (if
/// given), from `start` for all that it has and from each of the effects' starts; the `keep` best of them go to the
/// end.
[[nodiscard]] Candidate fit(const Study& study, const std::vector<const Effect*>& effects, const Candidate& start,
                            const Whitener* whitener, std::size_t keep);

/// Standard deviations of all that was fitted, from the whitened residuals' slopes.
void add_deviations(const Study& study, Candidate& candidate, const Whitener& whitener);

/// The same candidate on other records: base and lasting parameters stay, the records' own are fitted afresh.
[[nodiscard]] Candidate carried_over(const Study& study, const Candidate& fitted, const Whitener* whitener);

}  // namespace gap
