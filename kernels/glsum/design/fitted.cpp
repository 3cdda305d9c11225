#include "glsum/design/fitted.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "glsum/design/modes.hpp"
#include "glsum/design/projection.hpp"

namespace glsum::design {
namespace {

// Indices from K to N: each up to 25, then 4 % apart.
std::vector<std::size_t> log_spaced(std::size_t first, std::size_t last) {
    std::vector<std::size_t> indices;
    for (double at = static_cast<double>(first); at <= static_cast<double>(last); at = std::max(at + 1.0, at * 1.04)) {
        indices.push_back(static_cast<std::size_t>(std::lround(at)));
    }
    return indices;
}

// What the poles are chosen by: below every error that is designed for.
constexpr double mixture_error = 1e-10;

Projection poles_of(double order, std::size_t near_taps, std::size_t horizon) {
    // The weights behind K are mixtures of those before it too: of a tail that begins a little earlier.
    const std::size_t from = std::max(least_near_taps(order), near_taps - std::min<std::size_t>(near_taps, 2));
    return {tail_nodes(order, from, horizon, mixture_error), horizon};
}

Approximation fitted(const Projection& projection, const std::vector<double>& weights, std::size_t near_taps,
                     std::size_t modes) {
    Approximation found{near_taps, projection.modes(std::min(modes, projection.size())), 0.0};
    fit_weights(found.modes, weights, near_taps);
    found.error = error_of(weights, near_taps, found.modes, INFINITY);
    return found;
}

}  // namespace

void fit_weights(std::vector<Mode>& modes, const std::vector<double>& weights, std::size_t near_taps) {
    const std::vector<std::size_t> indices = log_spaced(near_taps, weights.size() - 1);
    const auto rows = static_cast<Eigen::Index>(indices.size());
    const auto columns = static_cast<Eigen::Index>(modes.size());
    Eigen::MatrixXd matrix(rows, columns);
    Eigen::VectorXd right(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const std::size_t j = indices[static_cast<std::size_t>(i)];
        const std::size_t here =
            static_cast<std::size_t>(i) + 1 < indices.size() ? static_cast<std::size_t>(i) : indices.size() - 2;
        const double width = indices.size() < 2 ? 1.0 : static_cast<double>(indices[here + 1] - indices[here]);
        const double weight = std::sqrt(static_cast<double>(j) * width);
        for (Eigen::Index m = 0; m < columns; ++m) {
            const double decay = modes[static_cast<std::size_t>(m)].decay;
            matrix(i, m) = weight * std::exp(static_cast<double>(j - near_taps) * std::log1p(-decay));
        }
        right(i) = weight * weights[j];
    }
    const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve(right);
    for (Eigen::Index m = 0; m < columns; ++m) {
        modes[static_cast<std::size_t>(m)].weight = solution(m);
    }
}

Approximation approximate_fitted(const std::vector<double>& weights, double order, std::size_t near_taps,
                                 std::size_t modes) {
    if (modes == 0) {
        return {near_taps, {}, error_of(weights, near_taps, {}, INFINITY)};
    }
    return fitted(poles_of(order, near_taps, weights.size() - 1), weights, near_taps, modes);
}

std::optional<Approximation> design_fitted(const std::vector<double>& weights, double order, double error) {
    std::optional<Approximation> best;
    for (const std::size_t near_taps : {4U, 6U, 8U, 12U, 16U, 24U, 32U}) {
        const Projection projection = poles_of(order, near_taps, weights.size() - 1);
        for (std::size_t modes = 1; modes <= std::min(most_modes, projection.size()); ++modes) {
            if (best && near_taps + 2 * modes >= best->length()) {
                break;
            }
            if (Approximation found = fitted(projection, weights, near_taps, modes); found.error <= error) {
                best = std::move(found);
                break;
            }
        }
    }
    return best;
}

}  // namespace glsum::design
