// The filter of given poles that errs least, and poles that err less. Included by band.cpp, and by a test of its own.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "glsum/design/band.hpp"

namespace glsum::design {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Of the weights that a kernel sums with: increments have one order less.
inline double order_of(const DerivativeGoal& goal, FilterKind kind) {
    return kind == FilterKind::increments ? goal.order - 1.0 : goal.order;
}

// What the filter is held against: every point two rows of relative error, the step's one and an empty one.
class Fit {
public:
    /// \param swing  above 0: the last of the poles lies in (-swing, 0)
    Fit(const DerivativeGoal& goal, std::size_t near_taps, FilterKind kind, double swing, double ridge)
        : near_taps_(near_taps),
          kind_(kind),
          swing_(swing),
          ridge_(ridge),
          slowest_(std::log(1e-6 / static_cast<double>(goal.horizon()))),
          samples_(design::samples_of(goal)) {
        for (const double hz : frequencies_of(goal)) {
            angles_.push_back(2.0 * std::numbers::pi * hz * goal.step_s);
            exact_.push_back(exact_response(goal.order, hz));
            differences_.push_back(difference_response(angles_.back()));
            delayed_.push_back(std::polar(1.0, -angles_.back() * static_cast<double>(near_taps)));
        }
        for (const std::size_t k : samples_) {
            exact_step_.push_back(exact_step(goal.order, static_cast<double>(k) * goal.step_s));
        }
        weights_ = Vector::Ones(points());
        taps_ = Matrix(2 * points(), static_cast<Eigen::Index>(near_taps));
        own_ = Vector(static_cast<Eigen::Index>(near_taps));
        double weight = std::pow(goal.step_s, -goal.order);
        for (std::size_t j = 0; j < near_taps; ++j) {
            const auto at = [&](std::size_t i) { return std::polar(1.0, -angles_[i] * static_cast<double>(j)); };
            const auto step = [&](std::size_t k) { return k >= j ? 1.0 : 0.0; };
            taps_.col(static_cast<Eigen::Index>(j)) = column(at, step);
            own_(static_cast<Eigen::Index>(j)) = weight;
            weight *= 1.0 - (1.0 + order_of(goal, kind)) / static_cast<double>(j + 1);
        }
    }

    // Starts with poles whose decays these are, of a negative pole the logit of its part of the largest; the running
    // sum is apart.
    void set(Vector log_decays) {
        const Eigen::Index modes = log_decays.size() + (integrator() ? 1 : 0);
        now_.matrix = Matrix(2 * points(), taps_.cols() + modes);
        now_.matrix.leftCols(taps_.cols()) = taps_;
        now_.decays = Vector::Constant(modes, std::numeric_limits<double>::quiet_NaN());
        now_ = solve(parted(std::move(log_decays)));
        error_ = error_of(now_.residual);
    }

    [[nodiscard]] double error() const { return error_; }
    [[nodiscard]] const Vector& log_decays() const { return now_.log_decays; }

    // A step of the poles for the present weights, then new weights from the errors that are left.
    void improve(bool move_poles) {
        if (move_poles && now_.log_decays.size() > 0) {
            step_poles();
        }
        Vector factor(points());
        double mean = 0.0;
        for (Eigen::Index i = 0; i < points(); ++i) {
            factor(i) = size_at(now_.residual, i);
            mean += weights_(i) * factor(i) / weights_.sum();
        }
        // Never to nothing: a point that is met exactly may come back.
        weights_ = weights_.cwiseProduct((factor / mean).cwiseMax(0.2).cwiseMin(5.0));
        weights_ /= weights_.mean();
        now_ = solve(now_.log_decays);
        error_ = error_of(now_.residual);
    }

    // A step of all unknowns at once towards the least of sum |e|^(2p): Newton's, whose second derivatives are those of
    // the power alone. The larger p, the nearer to the largest error, which weights alone come near but slowly.
    void sharpen(double p) {
        const double largest = error_;
        const auto power = [&](const Vector& residual) {
            double sum = 0.0;
            for (Eigen::Index i = 0; i < points(); ++i) {
                sum += std::pow(size_at(residual, i) / largest, 2.0 * p);
            }
            return sum;
        };
        const Eigen::Index coefficients = now_.matrix.cols();
        const Eigen::Index unknowns = coefficients + now_.log_decays.size();
        Matrix slopes(2 * points(), unknowns);
        slopes.leftCols(coefficients) = now_.matrix;
        for (Eigen::Index m = 0; m < now_.log_decays.size(); ++m) {
            Vector moved = now_.log_decays;
            moved(m) -= difference;
            const Eigen::Index mode = coefficients - now_.log_decays.size() + m;
            slopes.col(coefficients + m) =
                (now_.matrix - with_poles(moved).matrix).col(mode) * (now_.solution(mode) / difference);
        }
        // Along an error the power bends 2p - 1 times as much as across it.
        Matrix bent(2 * points(), unknowns);
        Vector right = Vector::Zero(2 * points());
        for (Eigen::Index i = 0; i < points(); ++i) {
            const double size = size_at(now_.residual, i);
            const double root = std::pow(size / largest, p - 1.0);
            const double along = std::sqrt(2.0 * p - 1.0);
            // A point that is met exactly has no direction, and its root is 0.
            const double unit = std::max(size, std::numeric_limits<double>::min());
            const double cosine = now_.residual(2 * i) / unit;
            const double sine = now_.residual(2 * i + 1) / unit;
            bent.row(2 * i) = root * along * (cosine * slopes.row(2 * i) + sine * slopes.row(2 * i + 1));
            bent.row(2 * i + 1) = root * (cosine * slopes.row(2 * i + 1) - sine * slopes.row(2 * i));
            right(2 * i) = -root * size / along;
        }
        const Vector scale = bent.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
        Matrix damped(bent.rows() + unknowns, unknowns);
        damped.topRows(bent.rows()) = bent * scale.cwiseInverse().asDiagonal();
        Vector wanted_step = Vector::Zero(damped.rows());
        wanted_step.head(right.size()) = right;
        const double now = power(now_.residual);
        for (int attempt = 0; attempt < 6; ++attempt, damping_ *= 8.0) {
            damped.bottomRows(unknowns) = std::sqrt(damping_) * Matrix::Identity(unknowns, unknowns);
            const Vector step = Eigen::HouseholderQR<Matrix>(damped).solve(wanted_step).cwiseQuotient(scale);
            Solved moved = with_poles(parted(now_.log_decays + step.tail(now_.log_decays.size())));
            moved.solution = now_.solution + step.head(coefficients);
            moved.residual = moved.matrix * moved.solution - wanted();
            if (power(moved.residual) < now) {
                now_ = std::move(moved);
                error_ = error_of(now_.residual);
                damping_ = std::max(1e-9, damping_ / 8.0);
                return;
            }
        }
        damping_ = 1e-2;
    }

    [[nodiscard]] Filter filter() const {
        Filter filter;
        for (std::size_t j = 0; j < near_taps_; ++j) {
            filter.taps.push_back(now_.solution(static_cast<Eigen::Index>(j)));
        }
        for (Eigen::Index m = 0; m < now_.decays.size(); ++m) {
            filter.modes.push_back({now_.decays(m), now_.solution(static_cast<Eigen::Index>(near_taps_) + m)});
        }
        return filter;
    }

private:
    // The least squares of some poles. What a pole adds at the points takes most of the time and changes with it alone.
    struct Solved {
        Vector log_decays;
        Vector decays;    // of these, and of the running sum
        Matrix matrix;    // a column for each tap and mode
        Vector solution;  // taps and weights of the modes
        Vector residual;  // before the points' weights
    };

    [[nodiscard]] bool integrator() const { return kind_ == FilterKind::integrator; }

    static constexpr double largest_decay = 0.95;  // beyond it a mode is but another tap
    static constexpr double difference = 1e-4;     // of a logarithm, for slopes
    static constexpr double least_gap = 0.3;       // of logarithms: nearer poles need huge weights of both signs

    // Rising, apart, none beyond the largest, and none that would never decay; a negative pole stays the last.
    [[nodiscard]] Vector parted(Vector log_decays) const {
        const Eigen::Index positive = log_decays.size() - (swing_ > 0.0 ? 1 : 0);
        std::sort(log_decays.begin(), log_decays.begin() + positive);
        double limit = std::log(largest_decay);
        for (Eigen::Index m = positive - 1; m >= 0; --m, limit -= least_gap) {
            log_decays(m) = limit = std::min(limit, log_decays(m));
        }
        for (Eigen::Index m = 0; m < positive; ++m) {
            log_decays(m) = std::max(log_decays(m), slowest_ + least_gap * static_cast<double>(m));
        }
        return log_decays;
    }

    [[nodiscard]] Eigen::Index points() const { return static_cast<Eigen::Index>(angles_.size() + samples_.size()); }

    // What a coefficient adds to the relative errors: by its answers to the sines and to a step of what is summed.
    template <class AtAngle, class AtSample>
    Vector column(const AtAngle& at_angle, const AtSample& at_sample) const {
        const bool increments = kind_ == FilterKind::increments;
        Vector column = Vector::Zero(2 * points());
        Eigen::Index row = 0;
        for (std::size_t i = 0; i < angles_.size(); ++i, row += 2) {
            const std::complex<double> relative = at_angle(i) * (increments ? differences_[i] : 1.0) / exact_[i];
            column(row) = relative.real();
            column(row + 1) = relative.imag();
        }
        for (std::size_t i = 0; i < samples_.size(); ++i, row += 2) {
            const double before = increments ? at_sample(samples_[i] - 1) : 0.0;
            column(row) = (at_sample(samples_[i]) - before) / exact_step_[i];
        }
        return column;
    }

    [[nodiscard]] double decay_of(const Vector& log_decays, Eigen::Index mode) const {
        const Eigen::Index at = integrator() ? mode - 1 : mode;
        if (at < 0) {
            return 0.0;
        }
        const bool swings = swing_ > 0.0 && at + 1 == log_decays.size();
        return swings ? 1.0 + swing_ / (1.0 + std::exp(-log_decays(at))) : std::exp(log_decays(at));
    }

    [[nodiscard]] double size_at(const Vector& residual, Eigen::Index point) const {
        return std::hypot(residual(2 * point), residual(2 * point + 1));
    }
    [[nodiscard]] double error_of(const Vector& residual) const {
        double largest = 0.0;
        for (Eigen::Index i = 0; i < points(); ++i) {
            largest = std::max(largest, size_at(residual, i));
        }
        return largest;
    }

    // What these poles add at the points.
    [[nodiscard]] Solved with_poles(const Vector& log_decays) const {
        Solved found{log_decays, now_.decays, now_.matrix, {}, {}};
        const auto near = static_cast<Eigen::Index>(near_taps_);
        for (Eigen::Index m = 0; m < found.decays.size(); ++m) {
            const double decay = decay_of(log_decays, m);
            if (decay != now_.decays(m)) {
                found.decays(m) = decay;
                found.matrix.col(near + m) =
                    column([&](std::size_t i) { return mode_response(decay, differences_[i], delayed_[i]); },
                           [&](std::size_t k) { return mode_step_response(decay, near_taps_, k); });
            }
        }
        return found;
    }

    [[nodiscard]] Solved solve(const Vector& log_decays) const {
        Solved found = with_poles(log_decays);
        const Matrix& matrix = found.matrix;
        const auto near = static_cast<Eigen::Index>(near_taps_);
        const Vector scale = matrix.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
        const Vector root = row_weights();
        // Behind the points a row for each coefficient, which asks for 0.
        const Eigen::Index unknowns = matrix.cols();
        Matrix weighted = Matrix::Zero(matrix.rows() + unknowns, unknowns);
        weighted.topRows(matrix.rows()) = root.asDiagonal() * matrix * scale.cwiseInverse().asDiagonal();
        weighted.bottomRows(unknowns).diagonal().setConstant(ridge_);
        Eigen::ColPivHouseholderQR<Matrix> qr(weighted);
        qr.setThreshold(1e-11);
        const Vector ones = wanted();
        Vector right = Vector::Zero(weighted.rows());
        right.head(ones.size()) = root.cwiseProduct(ones);
        found.solution = qr.solve(right).cwiseQuotient(scale);
        found.residual = matrix * found.solution - ones;
        for (Eigen::Index j = 0; j < near; ++j) {
            if (matrix.col(j).isZero(0.0)) {
                found.solution(j) = own_(j);
            }
        }
        return found;
    }

    [[nodiscard]] Vector wanted() const {
        Vector ones = Vector::Zero(2 * points());
        ones(Eigen::seqN(0, points(), 2)).setOnes();
        return ones;
    }
    // A point's own for both of its rows.
    [[nodiscard]] Vector row_weights() const {
        const Matrix of_both = weights_.cwiseSqrt().transpose().replicate(2, 1);
        return of_both.reshaped();
    }

    void step_poles() {
        const Vector root = row_weights();
        const Vector now = root.cwiseProduct(now_.residual);
        Matrix jacobian(now.size(), now_.log_decays.size());
        for (Eigen::Index m = 0; m < now_.log_decays.size(); ++m) {
            Vector moved = now_.log_decays;
            moved(m) -= difference;
            jacobian.col(m) = (now - root.cwiseProduct(solve(moved).residual)) / difference;
        }
        const Matrix normal = jacobian.transpose() * jacobian;
        const Vector gradient = jacobian.transpose() * now;
        for (int attempt = 0; attempt < 6; ++attempt, damping_ *= 8.0) {
            const Matrix damped = normal + damping_ * Matrix(normal.diagonal().asDiagonal()) +
                                  1e-12 * normal.trace() * Matrix::Identity(normal.rows(), normal.cols());
            const Vector step = damped.ldlt().solve(gradient).cwiseMax(-1.0).cwiseMin(1.0);
            Solved moved = solve(parted(now_.log_decays - step));
            if (root.cwiseProduct(moved.residual).squaredNorm() < now.squaredNorm()) {
                now_ = std::move(moved);
                damping_ = std::max(1e-6, damping_ / 4.0);
                return;
            }
        }
        damping_ = 1e-2;
    }

    std::size_t near_taps_;
    FilterKind kind_;
    double swing_;
    double ridge_;
    double slowest_;  // logarithm of a decay that the whole horizon hardly shows
    std::vector<double> angles_;
    std::vector<std::complex<double>> exact_;
    std::vector<std::complex<double>> differences_;  // 1 - z^-1
    std::vector<std::complex<double>> delayed_;      // z^-K
    std::vector<std::size_t> samples_;
    std::vector<double> exact_step_;
    Matrix taps_;
    Vector own_;  // the taps of the order's own weights, what is summed taken into account
    Vector weights_;
    Solved now_;
    double error_ = 0.0;
    double damping_ = 1e-2;
};

}  // namespace glsum::design
