// What cycles buy of a derivative over a band: fitted filters as kernels hold them, and beside them Oustaloup's and
// Charef's, tuned to the same band.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/choose/costs.hpp"
#include "bench/rows/row.hpp"
#include "glsum/design/derivative.hpp"
#include "glsum/design/rational.hpp"
#include "qemu/emulate/firmware.hpp"

namespace bench {

struct BandStudy {
    std::vector<double> orders{0.2, 0.5, 0.9, -0.5, -0.9, 1.5};
    std::vector<glsum::design::Band> bands{{8, 80}, {0.8, 80}, {0.08, 80}, {0.008, 80}};
    std::vector<std::size_t> poles{2, 3, 4, 5, 6, 7, 8};  ///< of others' filters; rising
    double step_s = 0.001;
    std::size_t longest = 20;  ///< taps of a kernel
    std::string core;          ///< of the timing model
    unsigned jobs = 1;
};

/// A filter at a length, of one order and band.
struct BandPoint {
    std::string way;   ///< a kernel, or one of `rivals`
    std::string taps;  ///< "1+5"
    double order;
    glsum::design::Band band;
    double error;  ///< over the band, relative to w^v
    double model_cycles;
    double model_cycles_high;
    double bytes;  ///< of state and coefficients
};

/// A filter of others in one of its forms.
struct Rival {
    const char* way;
    glsum::design::RationalRule rule;
    bool cascade;  ///< second-order sections; else one tap and modes
};
inline constexpr Rival rivals[] = {{"oustaloup_f32", glsum::design::RationalRule::oustaloup, false},
                                   {"oustaloup_df2t_f32", glsum::design::RationalRule::oustaloup, true},
                                   {"charef_f32", glsum::design::RationalRule::charef, false},
                                   {"charef_df2t_f32", glsum::design::RationalRule::charef, true}};
/// Null for a kernel.
[[nodiscard]] const Rival* rival_of(const std::string& way);

/// Who says what kernels cost, their designs counted as of an order.
using CostsOfOrder = std::function<std::unique_ptr<choose::CostSource>(const choose::CountedOrder&)>;

/// Of kernels: every length up to the longest, certified, with the format's rounding and the arithmetic's noise. Of
/// others' filters the same, in both forms: in parallel form in the cheapest kernel that can hold them
/// (`modes_plain_f32`, above order 1 `modesdelta_plain_f32`, 1+P), or where it cannot, the error in double at the
/// points of a search; and as a cascade of second-order sections (`cascade_df2t_f32`, `cascadedelta_df2t_f32`), where
/// single precision holds its poles. What cannot be run is left out.
[[nodiscard]] std::vector<BandPoint> measure_bands(const BandStudy& study, const CostsOfOrder& costs_of);
/// On a core of the emulated board. \throws glsum::Failure for a core without a file
[[nodiscard]] std::vector<BandPoint> measure_bands(const BandStudy& study, const qemu::Board& board);

/// Of each of others' filters: the least error of ours within its cycles.
struct BandRival {
    BandPoint rival;
    BandPoint ours;  ///< error infinite where none is as cheap
    [[nodiscard]] double ratio() const { return rival.error / ours.error; }
};
[[nodiscard]] std::vector<BandRival> compare_bands(const std::vector<BandPoint>& points);

/// Rows `band/<way>/order:<v>/taps:<L>/hz:<low>..<high>` with `band_error`, cycles and bytes.
[[nodiscard]] std::vector<Json> rows_of_bands(const std::vector<BandPoint>& points);

/// A table for each order, and in how many of all comparisons ours err less, by which factor.
[[nodiscard]] std::string to_table(const BandStudy& study, const std::vector<BandPoint>& points);

/// Writes `stem`.svg and `stem`.png: a panel for each order and band, error over cycles. \throws as `base::draw`
void plot_bands(const BandStudy& study, const std::vector<BandPoint>& points, const std::filesystem::path& stem);

}  // namespace bench
