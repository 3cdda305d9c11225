#include "modes/design.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "glsum/weights.hpp"

namespace glsum::modes {
namespace {

// An exponential of the trapezoid: b^2 e^(-s (j-K)).
struct Node {
    double rate;  // s
    double root;  // b
};

// Double-exponential decay at the right: beyond this exponent e^-x is below every double's last bit.
constexpr double largest_exponent = 38.0;

std::vector<Node> trapezoid(const Target& target, double near, double step) {
    const double v = target.order;
    const double density = std::fabs(std::sin(std::numbers::pi * v)) / std::numbers::pi;
    const double base_error = target.error * 1e-4;
    const double first = -std::log(static_cast<double>(target.horizon)) + 0.5 * std::log(base_error);
    const double last = std::log(largest_exponent / (near - v));
    std::vector<Node> nodes;
    // All nodes left of the first act like one slow mode; their geometric series are summed exactly.
    const double s0 = std::exp(first);
    const double total = step * density * std::pow(s0, 1.0 + v) / std::expm1((1.0 + v) * step);
    const double moment = step * density * std::pow(s0, 2.0 + v) / std::expm1((2.0 + v) * step);
    nodes.push_back({moment / total, std::sqrt(total)});
    for (double u = first; u < last; u += step) {
        const double s = std::exp(u);
        const double square = step * density * s * std::exp(-s * (near - v)) * std::pow(-std::expm1(-s), v);
        nodes.push_back({s, std::sqrt(square)});
    }
    return nodes;
}

// The Gramian's eigenvectors, the dominant ones first, and all its eigenvalues.
class Projection {
public:
    Projection(const Target& target, std::size_t near_taps, double step)
        : sign_(std::sin(std::numbers::pi * target.order) > 0.0 ? -1.0 : 1.0),
          nodes_(trapezoid(target, static_cast<double>(near_taps), step)) {
        const auto count = static_cast<Eigen::Index>(nodes_.size());
        const double discount = 2.0 / static_cast<double>(target.horizon);  // fits the infinite horizon to N
        Eigen::MatrixXd gramian(count, count);
        for (Eigen::Index i = 0; i < count; ++i) {
            for (Eigen::Index j = 0; j < count; ++j) {
                const Node& a = nodes_[static_cast<std::size_t>(i)];
                const Node& b = nodes_[static_cast<std::size_t>(j)];
                gramian(i, j) = a.root * b.root / -std::expm1(-(a.rate + b.rate + discount));
            }
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gramian);
        vectors_ = solver.eigenvectors().rowwise().reverse();
        values_ = solver.eigenvalues().reverse();
    }

    [[nodiscard]] std::size_t size() const { return nodes_.size(); }

    // Twice the sum of what is dropped: near the error, which is then computed exactly.
    [[nodiscard]] double dropped(std::size_t modes) const {
        const auto rest = values_.size() - static_cast<Eigen::Index>(modes);
        return 2.0 * values_.tail(rest).cwiseMax(0.0).sum();
    }

    [[nodiscard]] std::vector<Mode> modes(std::size_t count) const {
        if (count == 0) {
            return {};
        }
        const auto kept = vectors_.leftCols(static_cast<Eigen::Index>(count));
        Eigen::VectorXd decays(vectors_.rows());
        Eigen::VectorXd roots(vectors_.rows());
        for (Eigen::Index i = 0; i < vectors_.rows(); ++i) {
            decays(i) = -std::expm1(-nodes_[static_cast<std::size_t>(i)].rate);
            roots(i) = nodes_[static_cast<std::size_t>(i)].root;
        }
        const Eigen::MatrixXd compressed = kept.transpose() * decays.asDiagonal() * kept;
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(compressed);
        const Eigen::VectorXd projected = solver.eigenvectors().transpose() * (kept.transpose() * roots);
        std::vector<Mode> found;
        for (Eigen::Index m = 0; m < projected.size(); ++m) {
            found.push_back({solver.eigenvalues()(m), sign_ * projected(m) * projected(m)});
        }
        return found;
    }

private:
    double sign_;
    std::vector<Node> nodes_;
    Eigen::MatrixXd vectors_;
    Eigen::VectorXd values_;
};

double step_of(double error) {
    return std::clamp(std::numbers::pi * std::numbers::pi / std::log(1e4 / error), 0.3, 0.6);
}

// a_0 ... a_N.
std::vector<double> weights_to(double order, std::size_t horizon) {
    std::vector<double> weights = {1.0};
    weights.reserve(horizon + 1);
    for (Weights walk(order); weights.size() <= horizon;) {
        walk.next();
        weights.push_back(walk.weight());
    }
    return weights;
}

// sum_{j=K..N} |a_j - sum_m w_m r_m^(j-K)|; stops early once it is beyond `enough`.
double exact_error(const std::vector<double>& weights, std::size_t near_taps, const std::vector<Mode>& modes,
                   double enough) {
    std::vector<double> terms;
    for (const Mode& mode : modes) {
        terms.push_back(mode.weight);
    }
    double error = 0.0;
    for (std::size_t j = near_taps; j < weights.size() && error <= enough; ++j) {
        double sum = 0.0;
        for (std::size_t m = 0; m < modes.size(); ++m) {
            sum += terms[m];
            terms[m] -= modes[m].decay * terms[m];
        }
        error += std::fabs(weights[j] - sum);
    }
    return error;
}

constexpr double any = INFINITY;

}  // namespace

std::size_t least_near_taps(double order) {
    const double below = std::floor(order);
    const double least = below + (order - below > 0.75 ? 2.0 : 1.0);
    return least < 1.0 ? 1 : static_cast<std::size_t>(least);
}

Approximation approximate(const Target& target, std::size_t near_taps, std::size_t modes) {
    const Projection projection(target, near_taps, step_of(target.error));
    std::vector<Mode> found = projection.modes(std::min(modes, projection.size()));
    const double error = exact_error(weights_to(target.order, target.horizon), near_taps, found, any);
    return {near_taps, std::move(found), error};
}

std::optional<Approximation> design(const Target& target) {
    constexpr std::size_t most_modes = 40;
    constexpr std::size_t most_taps = 64;
    const std::vector<double> weights = weights_to(target.order, target.horizon);
    std::optional<Approximation> best;
    for (std::size_t near = least_near_taps(target.order); near <= most_taps; near += near < 8 ? 1 : 8) {
        if (best && near >= best->cost()) {
            break;
        }
        const Projection projection(target, near, step_of(target.error));
        for (std::size_t count = 0; count <= std::min(most_modes, projection.size()); ++count) {
            if (best && near + 2 * count >= best->cost()) {
                break;
            }
            // The exact error was never seen below a third of this estimate.
            if (count > 0 && projection.dropped(count) > 3.0 * target.error) {
                continue;
            }
            std::vector<Mode> modes = projection.modes(count);
            const double error = exact_error(weights, near, modes, target.error);
            if (error <= target.error) {
                best = Approximation{near, std::move(modes), error};
            }
        }
    }
    return best;
}

}  // namespace glsum::modes
