// What an error over a horizon takes, by each way: its rows, tables and picture.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/gnuplot.hpp"
#include "base/machines.hpp"
#include "bench/rows/row.hpp"
#include "glsum/design/mode.hpp"

namespace bench {

/// Of the sum, for |x| <= 1, before h^-v.
inline constexpr std::array horizon_errors = {1e-2, 1e-4, 1e-6};

struct HorizonCase {
    double order;
    double error;
    std::size_t samples;
    std::optional<std::size_t> window;  ///< multiplications; nothing: as many as samples, but one
    std::optional<std::size_t> blocks;  ///< multiplications; nothing: a window is as short
    std::optional<glsum::design::Approximation> modes;
    double largest_error = 0.0;       ///< of the modes' kernel over the whole record, found
    std::vector<double> cycles = {};  ///< modelled, on each of the cores; empty without any

    /// Multiplications of a window that keeps the error: all samples where no shorter one does.
    [[nodiscard]] std::size_t window_macs() const { return window.value_or(samples - 1); }
    /// The most that the modes may err: the design's certificate, and the rounding of both sides in double.
    [[nodiscard]] double promised() const;
};

/// Multiplications, counted as the kernels do (a_0 = 1 needs none), of the fewest taps that leave less than the error
/// of the weights up to the horizon; nothing where all are needed. \param weights  of all samples of the horizon
[[nodiscard]] std::optional<std::size_t> window_for(const std::vector<double>& weights, double error);

/// An emulated machine and the core whose cycles are modelled there.
struct HorizonCore {
    const base::Machine* machine;
    std::string core;
};

/// Those of a window, of blocks and of modes, where there is a design of each. The cycles of the first core stand in
/// the row of the modes, those of others in rows of their own. \param cores  in the order of the case's cycles
[[nodiscard]] std::vector<Json> to_rows(const HorizonCase& one, const std::vector<HorizonCore>& cores = {});

/// Of one order. \param cores  as above; several have a column each
[[nodiscard]] std::string to_table(double order, const std::vector<HorizonCase>& cases,
                                   const std::vector<HorizonCore>& cores = {});

/// Multiplications over the horizon: a panel for each order and error. \param cases  by rising horizon
[[nodiscard]] base::Picture picture_of(const std::vector<double>& orders, const std::vector<HorizonCase>& cases);

}  // namespace bench
