#include "gap/drive/information.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace gap {

std::optional<Told> told_by(const Study& study, Candidate candidate, const Whitener& whitener) {
    const auto all = [&](const Candidate& of) {
        std::vector<double> values;
        for (std::size_t r = 0; r < study.courses.size(); ++r) {
            std::vector<double> residuals = whitener.apply(residuals_of(study, of, r));
            for (std::size_t i = 0; i < residuals.size(); ++i) {
                values.push_back(study.counts[r][i] != 0 ? residuals[i] : 0.0);
            }
        }
        return values;
    };
    const std::vector<double> now = all(candidate);
    const auto rows = static_cast<Eigen::Index>(now.size());
    const std::vector<FreeParameter*> free = free_numbers(candidate, false);
    const auto own = static_cast<Eigen::Index>(free_numbers(candidate, true).size());
    const auto shared = static_cast<Eigen::Index>(free.size()) - own;
    Eigen::MatrixXd slopes(rows, shared + own);
    for (Eigen::Index p = 0; p < shared + own; ++p) {
        FreeParameter& parameter = *free[static_cast<std::size_t>(p)];
        const double value = parameter.value;
        constexpr double step = 3e-4;
        const double by = value + step * parameter.scale > parameter.upper ? -step : step;
        parameter.value = value + by * parameter.scale;
        const std::vector<double> moved = all(candidate);
        parameter.value = value;
        for (Eigen::Index i = 0; i < rows; ++i) {
            const auto at = static_cast<std::size_t>(i);
            slopes(i, p) = (moved[at] - now[at]) / by;
        }
    }
    if (!slopes.allFinite()) {
        return std::nullopt;
    }
    const Eigen::MatrixXd whole = slopes.transpose() * slopes;
    Told told{whole.topLeftCorner(shared, shared), 1.0};
    if (own > 0) {
        // What moves nothing here takes nothing from the others.
        Eigen::MatrixXd theirs = whole.bottomRightCorner(own, own);
        theirs.diagonal().array() += 1e-9 * theirs.trace() + 1e-300;
        told.information -=
            whole.topRightCorner(shared, own) * theirs.ldlt().solve(whole.bottomLeftCorner(own, shared));
    }
    double squares = 0.0;
    for (const double value : now) {
        squares += value * value;
    }
    told.variance = std::max(1.0, squares / static_cast<double>(std::max<Eigen::Index>(1, rows - shared - own)));
    return told;
}

std::vector<double> deviations_from(const Told& told, const Eigen::MatrixXd& information, Candidate candidate) {
    const std::vector<FreeParameter*> free = free_numbers(candidate, false);
    Eigen::MatrixXd known = information / told.variance;
    for (Eigen::Index p = 0; p < known.rows(); ++p) {
        const FreeParameter& parameter = *free[static_cast<std::size_t>(p)];
        const double half = 0.5 * (parameter.upper - parameter.lower) / parameter.scale;
        known(p, p) += 3.0 / (half * half);  // as of values that are spread evenly over them
    }
    const Eigen::MatrixXd inverse = known.ldlt().solve(Eigen::MatrixXd::Identity(known.rows(), known.rows()));
    std::vector<double> deviations;
    for (Eigen::Index p = 0; p < known.rows(); ++p) {
        deviations.push_back(std::sqrt(std::max(0.0, inverse(p, p))));
    }
    return deviations;
}

}  // namespace gap
