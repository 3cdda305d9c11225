// Records with everything that fits over them share.
#pragma once

#include <optional>
#include <vector>

#include "drive/fit.hpp"
#include "gap/drive/audit.hpp"
#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"

namespace gap {

/// What of the base may move: nothing when a given model is judged as it is; with `refit` the form's free parameters,
/// and of each record the operating point, the initial state and the input before it.
struct Base {
    drive::Form form;  ///< of the model, with its start values
    bool refit = false;
    double operating_output = 0.0;  ///< of a model that is not refitted
    bool from_no_input = false;     ///< a record's input before it is begun at 0, and not at the record's first level
    double idle_input = 0.0;        ///< the logged level that inputs are counted from
};

struct Study {
    Base base;
    Scales scales;
    std::vector<Course> courses;
    /// By record and sample: whether it counts here; a split record's other part does not.
    std::vector<std::vector<char>> counts;
    double noise;             ///< of readings, from sample to sample
    double least_deviation;   ///< of readings: what their quantum leaves, or a part in 5000 of their span
    std::size_t horizon = 0;  ///< residuals are of predictions so many samples ahead; 0: of the simulation
};

/// \param model  a start, or what is judged
[[nodiscard]] Scales scales_of(const drive::Model& model, const std::vector<Record>& records, const Audit& found);

/// The form's model with its start values.
[[nodiscard]] drive::Model model_of(const drive::Form& form);

/// Of each record all samples.
[[nodiscard]] std::vector<std::vector<char>> all_count(const std::vector<Record>& records);
/// Of each record every third of ten blocks is kept aside, or what lies behind the split: that or the rest.
[[nodiscard]] std::vector<std::vector<char>> part_counts(const std::vector<Record>& records,
                                                         std::optional<double> split_s, bool kept_aside);

/// An rms (in units of the readings) over what differs from sample to sample. Noise whose neighbours correlate by 0.9
/// is 3.8 times that, by 0.97 7 times.
[[nodiscard]] double over_noise(const Study& study, double rms);
/// Whether an rms is far beyond that: slow, and so not noise as sensors have it.
[[nodiscard]] bool is_slow(const Study& study, double rms);

/// Whether anything is put in: records without are free motions.
[[nodiscard]] bool is_driven(const std::vector<Record>& records);

/// Standard deviation of all their readings.
[[nodiscard]] double deviation_of(const std::vector<Record>& records);

/// Of what counts.
[[nodiscard]] double rms_of(const Study& study, const std::vector<std::vector<double>>& values);
/// Standard deviation of the measured output, of what counts.
[[nodiscard]] double output_deviation(const Study& study);

}  // namespace gap
