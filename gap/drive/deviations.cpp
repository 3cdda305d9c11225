#include "gap/drive/deviations.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "gap/drive/slopes.hpp"

namespace gap {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The directions of numbers that move anything, each over how much it does.
struct Directions {
    std::vector<Eigen::Index> moving;  // columns of the slopes
    Eigen::VectorXd length;            // of all columns
    Eigen::MatrixXd scaled;            // of the moving ones
    Eigen::MatrixXd vectors;
    Eigen::VectorXd told;  // inverse eigenvalues; 0: nothing tells it
};

constexpr double rounding = 1e-10;  // of what a direction moves, squared, that of differences

// \param untold  a direction that moves less, squared, than so much of what the one does that moves most
std::optional<Directions> directions_of(const Slopes& slopes, double untold = rounding) {
    Directions found;
    found.length = slopes.by_number.colwise().norm();
    for (Eigen::Index i = 0; i < found.length.size(); ++i) {
        if (found.length(i) > 0.0) {
            found.moving.push_back(i);
        }
    }
    if (found.moving.empty()) {
        return std::nullopt;
    }
    found.scaled = slopes.by_number(Eigen::all, found.moving) * found.length(found.moving).cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(found.scaled.transpose() * found.scaled);
    if (parts.info() != Eigen::Success) {
        return std::nullopt;
    }
    const double least = untold * parts.eigenvalues().maxCoeff();
    found.told = (parts.eigenvalues().array() > least).select(parts.eigenvalues().cwiseInverse(), 0.0);
    found.vectors = parts.eigenvectors();
    return found;
}

double in_untold(const Directions& directions, Eigen::Index i) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < directions.told.size(); ++k) {
        sum += directions.told(k) == 0.0 ? std::pow(directions.vectors(i, k), 2) : 0.0;
    }
    return sum;
}

// Standard deviations by least squares, from the residuals' size and from how blocks of them pull, whichever is larger:
// what is left of a fitted form is no noise, and says the same again and again. Infinite for what moves nothing, and
// for what moves with others in a direction that nothing tells.
/// \param least_variance  of the residuals: a perfect simulation of rounded readings has none
Eigen::VectorXd deviations_of(const Slopes& slopes, double least_variance) {
    const Eigen::VectorXd& residuals = slopes.residuals;
    const Eigen::Index rows = slopes.by_number.rows();
    const Eigen::Index columns = slopes.by_number.cols();
    Eigen::VectorXd spread = Eigen::VectorXd::Constant(columns, infinity);
    const auto directions = directions_of(slopes);
    if (!directions) {
        return spread;
    }
    const Eigen::MatrixXd inverse =
        directions->vectors * directions->told.asDiagonal() * directions->vectors.transpose();
    const double variance = std::max(
        least_variance, residuals.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, rows - columns)));
    constexpr Eigen::Index blocks = 24;
    Eigen::VectorXd pulled = Eigen::VectorXd::Zero(inverse.rows());
    for (Eigen::Index block = 0; block < blocks; ++block) {
        const Eigen::Index from = rows * block / blocks;
        const Eigen::Index count = rows * (block + 1) / blocks - from;
        const Eigen::VectorXd pull =
            inverse * (directions->scaled.middleRows(from, count).transpose() * residuals.segment(from, count));
        pulled += pull.cwiseAbs2();
    }
    for (Eigen::Index i = 0; i < inverse.rows(); ++i) {
        constexpr double alone = 0.9;
        if (in_untold(*directions, i) < alone) {
            const Eigen::Index column = directions->moving[static_cast<std::size_t>(i)];
            spread(column) = std::sqrt(std::max(variance * inverse(i, i), pulled(i))) / directions->length(column);
        }
    }
    return spread;
}

}  // namespace

void add_deviations(const Study& study, Candidate& candidate, const Whitener* whitener) {
    const std::vector<FreeParameter*> free = free_numbers(candidate, false);
    if (free.empty()) {
        return;
    }
    const auto slopes = slopes_of(study, candidate, free, whitener);
    Eigen::VectorXd spread = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(free.size()), infinity);
    if (slopes) {
        spread = deviations_of(*slopes, whitener != nullptr ? 1.0 : study.least_deviation * study.least_deviation);
    }
    for (std::size_t i = 0; i < free.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        free[i]->deviation = spread(column) * free[i]->scale;
        free[i]->moves_nothing = slopes && !(slopes->by_number.col(column).squaredNorm() > 0.0);
    }
}

std::vector<double> untold_shares(const Study& study, Candidate candidate, double untold) {
    const std::vector<FreeParameter*> free = free_numbers(candidate, false);
    std::vector<double> shares(free.size(), 0.0);
    const auto slopes = free.empty() ? std::nullopt : slopes_of(study, candidate, free, nullptr);
    const auto directions = slopes ? directions_of(*slopes, std::max(untold, rounding)) : std::nullopt;
    for (std::size_t i = 0; directions && i < directions->moving.size(); ++i) {
        shares[static_cast<std::size_t>(directions->moving[i])] = in_untold(*directions, static_cast<Eigen::Index>(i));
    }
    return shares;
}

}  // namespace gap
