#include "gap/drive/information.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "gap/drive/slopes.hpp"

namespace gap {

std::optional<Told> told_by(const Study& study, Candidate candidate, const Whitener& whitener) {
    const std::vector<FreeParameter*> free = free_numbers(candidate, false);
    const std::optional<Slopes> slopes = slopes_of(study, candidate, free, &whitener);
    if (!slopes) {
        return std::nullopt;
    }
    const auto own = static_cast<Eigen::Index>(free_numbers(candidate, true).size());
    const auto shared = static_cast<Eigen::Index>(free.size()) - own;
    const Eigen::MatrixXd whole = slopes->by_number.transpose() * slopes->by_number;
    Told told{whole.topLeftCorner(shared, shared), 1.0};
    if (own > 0) {
        // What moves nothing here takes nothing from the others.
        Eigen::MatrixXd theirs = whole.bottomRightCorner(own, own);
        theirs.diagonal().array() += 1e-9 * theirs.trace() + 1e-300;
        told.information -=
            whole.topRightCorner(shared, own) * theirs.ldlt().solve(whole.bottomLeftCorner(own, shared));
    }
    const Eigen::Index spare = slopes->residuals.size() - shared - own;
    told.variance =
        std::max(1.0, slopes->residuals.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, spare)));
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
