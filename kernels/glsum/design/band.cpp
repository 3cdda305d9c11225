#include "glsum/design/band.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "glsum/weights.hpp"

namespace glsum::design {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Of the weights that a kernel sums with: increments have one order less.
double order_of(const DerivativeGoal& goal, FilterKind kind) {
    return kind == FilterKind::increments ? goal.order - 1.0 : goal.order;
}

// What the filter is held against: every point two rows of relative error, the step's one and an empty one.
class Fit {
public:
    Fit(const DerivativeGoal& goal, std::size_t near_taps, FilterKind kind, double ridge)
        : near_taps_(near_taps), kind_(kind), ridge_(ridge), samples_(design::samples_of(goal)) {
        for (const double hz : frequencies_of(goal)) {
            angles_.push_back(2.0 * std::numbers::pi * hz * goal.step_s);
            exact_.push_back(exact_response(goal.order, hz));
        }
        for (const std::size_t k : samples_) {
            exact_step_.push_back(exact_step(goal.order, static_cast<double>(k) * goal.step_s));
        }
        weights_ = Vector::Ones(points());
        taps_ = Matrix(2 * points(), static_cast<Eigen::Index>(near_taps));
        own_ = Vector(static_cast<Eigen::Index>(near_taps));
        double weight = std::pow(goal.step_s, -goal.order);
        for (std::size_t j = 0; j < near_taps; ++j) {
            const auto at = [&](double angle) { return std::polar(1.0, -angle * static_cast<double>(j)); };
            const auto step = [&](std::size_t k) { return k >= j ? 1.0 : 0.0; };
            taps_.col(static_cast<Eigen::Index>(j)) = column(at, step);
            own_(static_cast<Eigen::Index>(j)) = weight;
            weight *= 1.0 - (1.0 + order_of(goal, kind)) / static_cast<double>(j + 1);
        }
    }

    // Starts with poles whose decays these are; the running sum is apart.
    void set(Vector log_decays) {
        log_decays_ = parted(std::move(log_decays));
        solve(log_decays_, solution_, residual_);
        error_ = error_of(residual_);
    }

    [[nodiscard]] double error() const { return error_; }
    [[nodiscard]] const Vector& log_decays() const { return log_decays_; }

    // A step of the poles for the present weights, then new weights from the errors that are left.
    void improve(bool move_poles) {
        if (move_poles && log_decays_.size() > 0) {
            step_poles();
        }
        Vector factor(points());
        double mean = 0.0;
        for (Eigen::Index i = 0; i < points(); ++i) {
            factor(i) = size_at(residual_, i);
            mean += weights_(i) * factor(i) / weights_.sum();
        }
        // Never to nothing: a point that is met exactly may come back.
        weights_ = weights_.cwiseProduct((factor / mean).cwiseMax(0.2).cwiseMin(5.0));
        weights_ /= weights_.mean();
        solve(log_decays_, solution_, residual_);
        error_ = error_of(residual_);
    }

    [[nodiscard]] Filter filter() const {
        Filter filter;
        for (std::size_t j = 0; j < near_taps_; ++j) {
            filter.taps.push_back(solution_(static_cast<Eigen::Index>(j)));
        }
        for (Eigen::Index m = 0; m < solution_.size() - static_cast<Eigen::Index>(near_taps_); ++m) {
            filter.modes.push_back({decay_of(log_decays_, m), solution_(static_cast<Eigen::Index>(near_taps_) + m)});
        }
        return filter;
    }

private:
    [[nodiscard]] bool integrator() const { return kind_ == FilterKind::integrator; }

    static constexpr double largest_decay = 0.95;  // beyond it a mode is but another tap
    static constexpr double least_gap = 0.3;       // of logarithms: nearer poles need huge weights of both signs

    // Rising, apart, and none beyond the largest.
    static Vector parted(Vector log_decays) {
        std::sort(log_decays.begin(), log_decays.end());
        double limit = std::log(largest_decay);
        for (Eigen::Index m = log_decays.size() - 1; m >= 0; --m, limit -= least_gap) {
            log_decays(m) = limit = std::min(limit, log_decays(m));
        }
        return log_decays;
    }

    [[nodiscard]] Eigen::Index points() const { return static_cast<Eigen::Index>(angles_.size() + samples_.size()); }

    // What a coefficient adds to the relative errors: by its answers to a sine and to a step of what is summed.
    template <class AtAngle, class AtSample>
    Vector column(const AtAngle& at_angle, const AtSample& at_sample) const {
        const bool increments = kind_ == FilterKind::increments;
        Vector column = Vector::Zero(2 * points());
        Eigen::Index row = 0;
        for (std::size_t i = 0; i < angles_.size(); ++i, row += 2) {
            const double half = std::sin(0.5 * angles_[i]);
            const std::complex<double> difference(2.0 * half * half, std::sin(angles_[i]));
            const std::complex<double> relative = at_angle(angles_[i]) * (increments ? difference : 1.0) / exact_[i];
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
        if (integrator()) {
            return mode == 0 ? 0.0 : std::exp(log_decays(mode - 1));
        }
        return std::exp(log_decays(mode));
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

    // Taps and weights of the modes for these poles. \param residual  before the points' weights
    void solve(const Vector& log_decays, Vector& solution, Vector& residual) const {
        const Eigen::Index modes = log_decays.size() + (integrator() ? 1 : 0);
        const auto near = static_cast<Eigen::Index>(near_taps_);
        Matrix matrix(2 * points(), near + modes);
        matrix.leftCols(near) = taps_;
        for (Eigen::Index m = 0; m < modes; ++m) {
            const double decay = decay_of(log_decays, m);
            matrix.col(near + m) = column([&](double angle) { return mode_response(decay, near_taps_, angle); },
                                          [&](std::size_t k) { return mode_step_response(decay, near_taps_, k); });
        }
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
        solution = qr.solve(right).cwiseQuotient(scale);
        residual = matrix * solution - ones;
        for (Eigen::Index j = 0; j < near; ++j) {
            if (matrix.col(j).isZero(0.0)) {
                solution(j) = own_(j);
            }
        }
    }

    [[nodiscard]] Vector wanted() const {
        Vector ones = Vector::Zero(2 * points());
        for (Eigen::Index i = 0; i < points(); ++i) {
            ones(2 * i) = 1.0;
        }
        return ones;
    }
    [[nodiscard]] Vector row_weights() const {
        Vector root(2 * points());
        for (Eigen::Index i = 0; i < points(); ++i) {
            root(2 * i) = root(2 * i + 1) = std::sqrt(weights_(i));
        }
        return root;
    }

    void step_poles() {
        const Vector root = row_weights();
        const Vector now = root.cwiseProduct(residual_);
        Matrix jacobian(now.size(), log_decays_.size());
        constexpr double difference = 1e-4;
        Vector solution;
        Vector residual;
        for (Eigen::Index m = 0; m < log_decays_.size(); ++m) {
            Vector moved = log_decays_;
            moved(m) -= difference;
            solve(moved, solution, residual);
            jacobian.col(m) = (now - root.cwiseProduct(residual)) / difference;
        }
        const Matrix normal = jacobian.transpose() * jacobian;
        const Vector gradient = jacobian.transpose() * now;
        for (int attempt = 0; attempt < 6; ++attempt, damping_ *= 8.0) {
            const Matrix damped = normal + damping_ * Matrix(normal.diagonal().asDiagonal()) +
                                  1e-12 * normal.trace() * Matrix::Identity(normal.rows(), normal.cols());
            const Vector step = damped.ldlt().solve(gradient).cwiseMax(-1.0).cwiseMin(1.0);
            const Vector moved = parted(log_decays_ - step);
            solve(moved, solution, residual);
            if (root.cwiseProduct(residual).squaredNorm() < now.squaredNorm()) {
                log_decays_ = moved;
                solution_ = solution;
                residual_ = residual;
                damping_ = std::max(1e-6, damping_ / 4.0);
                return;
            }
        }
        damping_ = 1e-2;
    }

    std::size_t near_taps_;
    FilterKind kind_;
    double ridge_;
    std::vector<double> angles_;
    std::vector<std::complex<double>> exact_;
    std::vector<std::size_t> samples_;
    std::vector<double> exact_step_;
    Matrix taps_;
    Vector own_;  // the taps of the order's own weights, what is summed taken into account
    Vector weights_;
    Vector log_decays_;
    Vector solution_;
    Vector residual_;
    double error_ = 0.0;
    double damping_ = 1e-2;
};

// From the slowest that the goal shows to the fastest, evenly in the logarithm.
Vector spread(const DerivativeGoal& goal, Eigen::Index modes, double slow, double fast) {
    const double time_s = static_cast<double>(goal.horizon()) * goal.step_s;
    const double period_s = goal.band ? 1.0 / (2.0 * std::numbers::pi * goal.band->low_hz) : 0.0;
    const double longest_s = goal.step_until_s ? std::max(*goal.step_until_s, period_s) : std::min(time_s, period_s);
    const double high = goal.band ? 2.0 * std::numbers::pi * goal.band->high_hz * goal.step_s : 0.1;
    const double last = std::log(std::min(0.7, fast * high));
    const double first = std::min(std::log(slow * goal.step_s / longest_s), last - 0.1);
    return modes == 1 ? Vector::Constant(1, 0.5 * (first + last)) : Vector::LinSpaced(modes, first, last).eval();
}

// What rounding is multiplied by: the magnitudes of all coefficients in units of the first, a mode's by the range of
// its average. A filter of less error is not taken where this is so many times that of the order's own weights.
constexpr double largest_amplification = 8.0;
double amplification(const Filter& filter) {
    double sum = 0.0;
    for (const double tap : filter.taps) {
        sum += std::fabs(tap);
    }
    for (const Mode& mode : filter.modes) {
        sum += std::fabs(mode.weight) / (mode.decay == 0.0 ? 1.0 : mode.decay);
    }
    // One that begins with no coefficient above 0 is no w_0 of a sum.
    return filter.taps.front() > 0.0 ? sum / filter.taps.front() : std::numeric_limits<double>::infinity();
}

constexpr int rough_rounds = 6;
constexpr int rounds = 60;

// What a coefficient of the size of its column's norm counts as: tried in turn until coefficients are not too large.
constexpr double ridges[] = {0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};

// \param most  of the amplification, if there is one with less
Filter fitted(const DerivativeGoal& goal, std::size_t near_taps, std::size_t modes, FilterKind kind, double ridge,
              double most) {
    const auto moving = static_cast<Eigen::Index>(modes) - (kind == FilterKind::integrator ? 1 : 0);
    Vector start = Vector::Zero(std::max<Eigen::Index>(moving, 0));
    if (moving > 0) {
        double least = std::numeric_limits<double>::infinity();
        for (const double slow : {0.1, 0.3, 1.0, 3.0}) {
            for (const double fast : {0.5, 1.5}) {
                // Derivatives want several at the fast end, where steps from a spread do not bring them.
                for (Eigen::Index crowd = 0; crowd <= std::min<Eigen::Index>(3, moving - 1); ++crowd) {
                    Fit fit(goal, near_taps, kind, ridge);
                    Vector from = Vector::Zero(moving);
                    from.head(moving - crowd) = spread(goal, moving - crowd, slow, fast);
                    fit.set(from);
                    for (int round = 0; round < rough_rounds; ++round) {
                        fit.improve(true);
                    }
                    if (fit.error() < least) {
                        least = fit.error();
                        start = fit.log_decays();
                    }
                }
            }
        }
    }
    Fit fit(goal, near_taps, kind, ridge);
    fit.set(start);
    Filter best = fit.filter();
    double least = amplification(best) <= most ? fit.error() : std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) {
        fit.improve(round < rounds / 2 || round % 2 == 0);
        if (fit.error() < least && amplification(fit.filter()) <= most) {
            least = fit.error();
            best = fit.filter();
        }
    }
    return best;
}

}  // namespace

Filter FittedFilter::filter() const {
    Filter filter{{factor}, modes};
    for (const double weight : weights) {
        filter.taps.push_back(factor * weight);
    }
    for (Mode& mode : filter.modes) {
        mode.weight *= factor;
    }
    return kind == FilterKind::increments ? of_samples(filter) : filter;
}

FittedFilter fit_filter(const DerivativeGoal& goal, std::size_t near_taps, std::size_t modes, FilterKind kind) {
    const double most = largest_amplification * absolute_sum(order_of(goal, kind), goal.horizon() + 1);
    Filter best;
    for (const double ridge : ridges) {
        best = fitted(goal, near_taps, modes, kind, ridge, most);
        if (amplification(best) <= most) {
            break;
        }
    }
    std::sort(best.modes.begin(), best.modes.end(), [](const Mode& a, const Mode& b) { return a.decay < b.decay; });
    const Filter whole = kind == FilterKind::increments ? of_samples(best) : best;
    FittedFilter found{best.taps.front(), {}, best.modes, error_at_points(whole, goal), kind};
    for (std::size_t j = 1; j < best.taps.size(); ++j) {
        found.weights.push_back(best.taps[j] / found.factor);
    }
    for (Mode& mode : found.modes) {
        mode.weight /= found.factor;
    }
    return found;
}

}  // namespace glsum::design
