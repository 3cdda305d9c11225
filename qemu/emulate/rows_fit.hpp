// How well predicted cycles meet measured ones: errors, the band's coverage and width, lines through rows of one
// function.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "qemu/emulate/measured_calls.hpp"
#include "qemu/emulate/predicted_calls.hpp"

namespace qemu {

/// What a row may miss by: this share of the measured cycles, or so many cycles of a call.
inline constexpr double allowed_share = 0.05;
inline constexpr double allowed_cycles = 8.0;
/// \param predicted, measured  cycles of a call
[[nodiscard]] bool misses(double predicted, double measured);

/// By what the longest call exceeds the shortest: calls of nearly one length determine no line.
inline constexpr double longer_call = 1.25;

/// The quantile of what a band promises: a band holds 95 % of unseen rows.
inline constexpr double band_coverage = 0.95;

/// The middle one, or the mean of two in the middle. \param values  at least one
[[nodiscard]] double median_of(std::vector<double> values);

struct RowFit {
    double error;       ///< predicted over measured, less 1
    double half_width;  ///< of the band, as a share of the predicted cycles
    bool inside;        ///< the measured cycles lie in the band, its edges included
    bool missed;
    /// Gneiting and Raftery's score of the band (JASA 102 (2007) 359), as a share of the measured cycles; smaller is
    /// better: its width, and 2 / (1 - `band_coverage`) times the distance of a value that lies outside.
    double interval_score;
};

/// Rows of one function in one placement: calls of different length.
struct RowLine {
    std::string function;
    std::string core;
    std::string code;
    std::string data;
    std::size_t rows;
    double measured_slope;  ///< cycles an executed instruction, by least squares
    double predicted_slope;
    double measured_constant;  ///< cycles of a call
    double predicted_constant;
};

/// What a band does on some rows.
struct BandFit {
    double half_width;  ///< median, share of the predicted cycles
    double inside;      ///< share of the rows
    double interval_score;
};

/// Rows that a band is judged by as if they were unseen: a group, or an author's groups, which share what comes before
/// the first "/" of their names.
struct GroupLeftOut {
    std::string group;
    bool is_author;
    std::size_t rows;
    BandFit as_it_is;
    /// The model's band, widened or narrowed to hold `band_coverage` of the rows of all others.
    double scale;
    BandFit from_others;
};

struct RowsFit {
    std::vector<RowFit> rows;
    double median_error;       ///< absolute
    double worst_error;        ///< with its sign
    double inside;             ///< share of the rows
    double median_half_width;  ///< share of the predicted cycles
    double mean_interval_score;
    std::size_t missed;
    std::vector<RowLine> lines;          ///< of functions with calls of different length, a quarter more at least
    std::vector<std::size_t> worst;      ///< rows, the worst first
    std::vector<GroupLeftOut> left_out;  ///< where the rows are of several groups
};

/// \param predicted  a row each
[[nodiscard]] RowsFit fit_of(const std::vector<MeasuredCall>& rows, const std::vector<PredictedCall>& predicted);

/// All of it for people. \param name  of the file of the rows
[[nodiscard]] std::string to_text(const std::string& name, const std::vector<MeasuredCall>& rows,
                                  const std::vector<PredictedCall>& predicted, const RowsFit& fit);

/// Schema `glsum-silicon-rows-1`.
[[nodiscard]] std::string to_json(const std::string& name, const std::vector<MeasuredCall>& rows,
                                  const std::vector<PredictedCall>& predicted, const RowsFit& fit);

}  // namespace qemu
