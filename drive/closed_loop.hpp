// A loop that a known controller closes: it reads at each stamp, and what it puts out is held until the next.
//
//   e_k = r_k - z_k,   u = C(s) of the held e,   z = G(s) of the held u, and what disturbs the reading
//
// The plant's output is exact, from rest; a reading sees the input before its stamp alone, so that no loop is
// algebraic.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "drive/controller.hpp"
#include "drive/inverse_laplace.hpp"
#include "drive/model.hpp"

namespace drive {

/// Longer records in a closed loop are refused: the cost grows with the square of the samples.
inline constexpr std::size_t most_loop_samples = 20'000;

struct LoopRun {
    std::vector<double> output;     ///< of the plant, at the stamps
    std::vector<double> input;      ///< what the controller put out from each stamp on
    Eigen::MatrixXd sensitivities;  ///< of the output, a column for each parameter; empty if none were asked for
};

/// How a plant's numbers move with parameters.
struct Sensitivity {
    const Eigen::MatrixXd* chain;  ///< d number / d parameter, numbers in the order of the plant's transforms
    std::ptrdiff_t offset_column;  ///< of the parameter that is the offset; -1: none
};

/// \param plant  the step response, and behind it its derivatives by the model's numbers where `sensitivity` is given:
/// so many `functions` \param delay_s  of the plant \param offset  of the reading
/// \param disturbance  of the reading at each stamp, or empty
/// \throws glsum::Failure (check failed) where the loop does not stay finite, (bad input) for too many samples
[[nodiscard]] LoopRun run_loop(InverseLaplace& plant, std::size_t functions, double delay_s, const Model& controller,
                               std::span<const double> time_s, std::span<const double> reference, double offset,
                               std::span<const double> disturbance, const std::optional<Sensitivity>& sensitivity);

/// The same of a model, without sensitivities.
[[nodiscard]] LoopRun run_loop(const Model& plant, const Model& controller, std::span<const double> time_s,
                               std::span<const double> reference, double offset = 0.0,
                               std::span<const double> disturbance = {});

/// The reference that a logged input and output leave no choice about.
/// \throws glsum::Failure (bad input) unless the controller answers an error at once
[[nodiscard]] std::vector<double> recover_reference(const Model& controller, std::span<const double> time_s,
                                                    std::span<const double> input, std::span<const double> output);

}  // namespace drive
