#include "gap/drive/residuals/flexible.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "gap/drive/residuals/features.hpp"

namespace gap {
namespace {

constexpr std::size_t folds = 4;
constexpr std::size_t blocks_per_record = 24;

std::size_t block_of(std::size_t i, std::size_t size) { return i * blocks_per_record / size; }

// What the other folds say of each sample of the judged records.
struct Trial {
    std::vector<std::vector<double>> left;
    double squares = 0.0;
};

}  // namespace

Flexible explain(const std::vector<Remainder>& judge, const std::vector<Remainder>& also, double delay_s,
                 double time_constant_s) {
    std::vector<const Remainder*> all;
    for (const auto* list : {&judge, &also}) {
        for (const Remainder& one : *list) {
            all.push_back(&one);
        }
    }
    const Range range = range_of(all);
    Flexible result;
    for (const Remainder& one : judge) {
        result.left.push_back(one.residuals);
    }
    if (!(range.high > range.low) || !(range.input > 0.0) || !(range.speed > 0.0)) {
        return result;
    }
    std::vector<Eigen::MatrixXd> features;
    for (const Remainder* one : all) {
        features.push_back(features_of(*one, range, delay_s, time_constant_s));
    }
    // Sums of squares of each fold, so that the others' is one addition.
    const Eigen::Index columns = features.front().cols();
    std::array<Eigen::MatrixXd, folds> squares;
    std::array<Eigen::VectorXd, folds> along;
    squares.fill(Eigen::MatrixXd::Zero(columns, columns));
    along.fill(Eigen::VectorXd::Zero(columns));
    for (std::size_t r = 0; r < all.size(); ++r) {
        const std::size_t size = all[r]->residuals.size();
        for (std::size_t from = 0; from < size;) {
            std::size_t to = from;
            while (to < size && block_of(to, size) == block_of(from, size)) {
                ++to;
            }
            const std::size_t fold = block_of(from, size) % folds;
            Eigen::MatrixXd part =
                features[r].middleRows(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(to - from));
            Eigen::VectorXd target = Eigen::Map<const Eigen::VectorXd>(all[r]->residuals.data() + from,
                                                                       static_cast<Eigen::Index>(to - from));
            for (std::size_t i = from; i < to; ++i) {
                if (all[r]->counts[i] == 0) {
                    part.row(static_cast<Eigen::Index>(i - from)).setZero();
                    target(static_cast<Eigen::Index>(i - from)) = 0.0;
                }
            }
            squares[fold] += part.transpose() * part;
            along[fold] += part.transpose() * target;
            from = to;
        }
    }
    Eigen::MatrixXd all_squares = Eigen::MatrixXd::Zero(columns, columns);
    Eigen::VectorXd all_along = Eigen::VectorXd::Zero(columns);
    for (std::size_t fold = 0; fold < folds; ++fold) {
        all_squares += squares[fold];
        all_along += along[fold];
    }
    Trial best;
    bool any = false;
    for (const double ridge : {1e-4, 1e-3, 1e-2, 1e-1}) {
        std::array<Eigen::VectorXd, folds> weights;
        for (std::size_t fold = 0; fold < folds; ++fold) {
            Eigen::MatrixXd normal = all_squares - squares[fold];
            normal.diagonal().array() += ridge * normal.trace() / static_cast<double>(columns);
            weights[fold] = normal.ldlt().solve(all_along - along[fold]);
        }
        Trial trial;
        for (std::size_t r = 0; r < judge.size(); ++r) {
            trial.left.push_back(judge[r].residuals);
            const std::size_t size = judge[r].residuals.size();
            for (std::size_t i = 0; i < size; ++i) {
                const std::size_t fold = block_of(i, size) % folds;
                trial.left[r][i] -= features[r].row(static_cast<Eigen::Index>(i)).dot(weights[fold]);
                trial.squares += judge[r].counts[i] != 0 ? trial.left[r][i] * trial.left[r][i] : 0.0;
            }
        }
        if (!any || trial.squares < best.squares) {
            best = std::move(trial);
            any = true;
        }
    }
    double before = 0.0;
    std::vector<double> gains;
    for (std::size_t r = 0; r < judge.size(); ++r) {
        const std::size_t size = judge[r].residuals.size();
        std::vector<double> gain(blocks_per_record, 0.0);
        std::vector<char> used(blocks_per_record, 0);
        for (std::size_t i = 0; i < size; ++i) {
            if (judge[r].counts[i] != 0) {
                const double was = judge[r].residuals[i] * judge[r].residuals[i];
                before += was;
                gain[block_of(i, size)] += was - best.left[r][i] * best.left[r][i];
                used[block_of(i, size)] = 1;
            }
        }
        for (std::size_t b = 0; b < blocks_per_record; ++b) {
            if (used[b] != 0) {
                gains.push_back(gain[b]);
            }
        }
    }
    if (!std::isfinite(best.squares) || !(best.squares < before) || gains.size() < 4) {
        return result;
    }
    const auto count = static_cast<double>(gains.size());
    double mean = 0.0;
    for (const double gain : gains) {
        mean += gain / count;
    }
    double variance = 0.0;
    double better = 0.0;
    for (const double gain : gains) {
        variance += (gain - mean) * (gain - mean) / (count - 1.0);
        better += gain > 0.0 ? 1.0 : 0.0;
    }
    result.explained = 1.0 - best.squares / before;
    // By the mean, or where one event holds most of the gap, by how many blocks gain.
    result.certain = mean > 2.5 * std::sqrt(variance / count) || better > 0.5 * count + 1.5 * std::sqrt(count);
    result.left = std::move(best.left);
    return result;
}

}  // namespace gap
