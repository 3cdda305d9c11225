// The fewest multiplications that step a model within an error.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bench/steppers/model/full_memory.hpp"
#include "bench/steppers/model/stepped.hpp"

namespace generate {

/// How far a stepped model is off, as a part of the largest output of each record.
struct ModelErrors {
    double step = 0.0;    ///< from the exact response to a unit step
    double random = 0.0;  ///< from its scheme in double with full memory, for an input that jumps within [-1, 1)
};

/// In q31 the records are run at so much of the input's full scale.
inline constexpr double fixed_level = 0.5;

/// Unit steps of `samples` samples behind the dead time, random inputs of 20 000.
class ModelJudge {
public:
    /// \pre the model is stable or integrating
    ModelJudge(const drive::Model& model, double step_s, std::size_t samples);
    [[nodiscard]] ModelErrors errors_of(const ModelSpec& spec) const;
    /// What the writing's sampling alone errs, for a unit step: in double with full memory.
    [[nodiscard]] double scheme_error(drive::Writing writing, const ModelSpec& spec) const;

private:
    struct Record {
        std::vector<double> input;
        std::vector<double> expected;
        double peak = 0.0;
    };
    template <class Step>
    [[nodiscard]] static double error_of(const Record& record, Step&& step);
    [[nodiscard]] double error_of(const ModelSpec& spec, const Record& record) const;
    [[nodiscard]] Swing swing(const ModelSpec& spec) const;

    Record step_;
    Record random_delta_;  ///< what the scheme of each writing makes of it
    Record random_bdf2_;
    mutable std::optional<Swing> swing_delta_;  ///< once it is asked for
    mutable std::optional<Swing> swing_bdf2_;
};

struct ModelChoice {
    ModelSpec spec;
    ModelErrors errors;
    double scheme = 0.0;     ///< `ModelJudge::scheme_error` of its writing
    double loop_gain = 0.0;  ///< `drive::RealtimeModel::loop_gain`
};

/// \param input_full_scale  in q31; without: in single precision
/// The first by multiplications whose `step` and `random` are within `max_error`, of first order in h before second.
/// \throws glsum::Failure (bad input) for a model that cannot be stepped (a numerator with derivatives, an unstable
/// one), (check failed) where none is, with the nearest
[[nodiscard]] ModelChoice choose_model(const drive::Model& model, double step_s, double max_error, std::size_t samples,
                                       std::optional<double> input_full_scale = {});

}  // namespace generate
