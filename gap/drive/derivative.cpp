#include "gap/drive/derivative.hpp"

#include <algorithm>
#include <cmath>

#include "glsum/weights.hpp"

namespace gap {
namespace {

// (1-z)^(v-1) ((3-z)/2)^v: the first 40 terms of the second factor are all that a double holds, as they fall like 3^-j.
class IncrementWeights {
public:
    IncrementWeights(double order, std::size_t horizon) : plain_{1.0}, factor_{std::pow(1.5, order)} {
        plain_.reserve(horizon + 1);
        for (glsum::Weights walk(order - 1.0); plain_.size() <= horizon;) {
            walk.next();
            plain_.push_back(walk.weight());
        }
        for (std::size_t j = 1; j < 40; ++j) {
            factor_.push_back(factor_.back() * (1.0 - (1.0 + order) / static_cast<double>(j)) / 3.0);
        }
    }
    [[nodiscard]] double at(std::size_t k) const {
        double sum = 0.0;
        for (std::size_t j = std::min(k + 1, factor_.size()); j-- > 0;) {
            sum += factor_[j] * plain_[k - j];
        }
        return sum;
    }

private:
    std::vector<double> plain_;
    std::vector<double> factor_;
};

}  // namespace

Exponentials::Exponentials(std::size_t horizon) : horizon_(std::max<std::size_t>(horizon, 32)) {
    // Five decays a decade, from one that lasts twice the record to one gone in half a sample.
    const double slowest = 2.0 * static_cast<double>(horizon_);
    const auto count = static_cast<Eigen::Index>(std::ceil(5.0 * std::log10(slowest / 0.5)));
    ratios_.resize(count);
    for (Eigen::Index m = 0; m < count; ++m) {
        const double samples =
            slowest * std::pow(0.5 / slowest, static_cast<double>(m) / static_cast<double>(count - 1));
        ratios_(m) = std::exp(-1.0 / samples);
    }
    for (double at = near_count; at <= static_cast<double>(horizon_); at = std::max(at + 1.0, at * 1.05)) {
        indices_.push_back(static_cast<std::size_t>(std::lround(at)));
    }
    const auto rows = static_cast<Eigen::Index>(indices_.size());
    row_weights_.resize(rows);
    Eigen::MatrixXd matrix(rows, count);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const auto j = static_cast<double>(indices_[at]);
        const double width = at + 1 < indices_.size() ? static_cast<double>(indices_[at + 1]) - j : 1.0;
        row_weights_(i) = std::sqrt(j * width);  // every decade alike
        for (Eigen::Index m = 0; m < count; ++m) {
            matrix(i, m) = row_weights_(i) * std::pow(ratios_(m), j - static_cast<double>(near_count));
        }
    }
    solver_.compute(matrix);
    solver_.setThreshold(1e-10);
}

Table Exponentials::table(double order) const {
    const std::lock_guard lock(*mutex_);
    const auto known = tables_.find(order);
    if (known != tables_.end()) {
        return known->second;
    }
    if (tables_.size() >= most_tables) {
        tables_.clear();
    }
    return tables_.emplace(order, make_table(order)).first->second;
}

Table Exponentials::make_table(double order) const {
    const bool whole = std::floor(order) == order;
    const IncrementWeights weights(order, whole ? static_cast<std::size_t>(near_count) : horizon_);
    Table table;
    table.near.resize(near_count);
    for (Eigen::Index k = 0; k < near_count; ++k) {
        table.near(k) = weights.at(static_cast<std::size_t>(k));
    }
    if (whole) {
        table.far = Eigen::VectorXd::Zero(ratios_.size());
        return table;  // the rest is a power of 1/3 too small to matter
    }
    Eigen::VectorXd right(static_cast<Eigen::Index>(indices_.size()));
    for (Eigen::Index i = 0; i < right.size(); ++i) {
        right(i) = row_weights_(i) * weights.at(indices_[static_cast<std::size_t>(i)]);
    }
    table.far = solver_.solve(right);
    return table;
}

bool ShortPast::holds(const Table& table) {
    constexpr Eigen::Index held = most + 1;
    return (table.far.array() == 0.0).all() && (table.near.tail(table.near.size() - held).array() == 0.0).all();
}

ShortPast::ShortPast(const Table& table) : newest_(table.near(0)) {
    for (std::size_t j = 0; j < most; ++j) {
        weights_[j] = table.near(static_cast<Eigen::Index>(j) + 1);
    }
}

Past::Past(const Exponentials& exponentials, Table table)
    : exponentials_(&exponentials),
      table_(std::move(table)),
      near_(Eigen::VectorXd::Zero(2 * Exponentials::near_count)),
      states_(Eigen::ArrayXd::Zero(exponentials.ratios().size())) {}

double Past::without_last() const {
    // near_[head] is e_(k-1).
    constexpr Eigen::Index older = Exponentials::near_count - 2;
    return table_.near.tail(older).dot(near_.segment(head_ + 1, older)) + (table_.far.array() * states_).sum();
}

void Past::push(double increment) {
    constexpr Eigen::Index behind = Exponentials::near_count - 1;
    // The oldest of the near ones moves to the exponentials: next time it is near_count samples back.
    states_ = states_ * exponentials_->ratios() + near_(head_ + behind - 1);
    head_ = head_ == 0 ? behind - 1 : head_ - 1;
    near_(head_) = increment;
    near_(head_ + behind) = increment;
    older_ = without_last();
}

void Past::fill_near(double increment) {
    near_.setConstant(increment);
    older_ = without_last();
}

}  // namespace gap
