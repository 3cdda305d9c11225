#include "glsum/design/projection.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace glsum::design {
namespace {

// Double-exponential decay at the right: beyond this exponent e^-x is below every double's last bit.
constexpr double largest_exponent = 38.0;

// The trapezoid's error falls as exp(-pi^2/step).
double step_for(double error) {
    return std::clamp(std::numbers::pi * std::numbers::pi / std::log(1e4 / error), 0.3, 0.6);
}

}  // namespace

std::vector<Node> tail_nodes(double order, std::size_t near_taps, std::size_t horizon, double error) {
    const double v = order;
    const double room = static_cast<double>(near_taps) - v;
    const double step = step_for(error);
    const double density = step * std::fabs(std::sin(std::numbers::pi * v)) / std::numbers::pi;
    const double first = -std::log(static_cast<double>(horizon)) + 0.5 * std::log(error * 1e-4);
    const double last = std::log(largest_exponent / room);
    std::vector<Node> nodes;
    // All nodes left of the first act like one slow mode; their geometric series are summed exactly, to the second power
    // of s: s e^(-s room) (1 - e^(-s))^v = s^(1+v) (1 - (room + v/2) s + ...).
    const double s0 = std::exp(first);
    const double moment = density * std::pow(s0, 2.0 + v) / std::expm1((2.0 + v) * step);
    const double total = density * std::pow(s0, 1.0 + v) / std::expm1((1.0 + v) * step) - (room + 0.5 * v) * moment;
    nodes.push_back({moment / total, std::sqrt(total)});
    for (double u = first; u < last; u += step) {
        const double s = std::exp(u);
        nodes.push_back({s, std::sqrt(density * s * std::exp(-s * room) * std::pow(-std::expm1(-s), v))});
    }
    return nodes;
}

std::size_t least_near_taps(double order) {
    const double below = std::floor(order);
    const double least = below + (order - below > 0.75 ? 2.0 : 1.0);
    return least < 1.0 ? 1 : static_cast<std::size_t>(least);
}

Projection::Projection(std::vector<Node> nodes, std::size_t horizon) : nodes_(std::move(nodes)) {
    const auto count = static_cast<Eigen::Index>(nodes_.size());
    const double discount = 2.0 / static_cast<double>(horizon);
    Eigen::MatrixXd gramian(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        for (Eigen::Index j = 0; j < count; ++j) {
            const Node& a = nodes_[static_cast<std::size_t>(i)];
            const Node& b = nodes_[static_cast<std::size_t>(j)];
            gramian(i, j) = a.root * b.root / -std::expm1(-(a.rate + b.rate + discount));
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gramian);
    vectors_.resize(nodes_.size() * nodes_.size());
    values_.resize(nodes_.size());
    Eigen::Map<Eigen::MatrixXd>(vectors_.data(), count, count) = solver.eigenvectors().rowwise().reverse();
    Eigen::Map<Eigen::VectorXd>(values_.data(), count) = solver.eigenvalues().reverse();
}

double Projection::dropped(std::size_t count) const {
    const Eigen::Map<const Eigen::VectorXd> values(values_.data(), static_cast<Eigen::Index>(values_.size()));
    return 2.0 * values.tail(values.size() - static_cast<Eigen::Index>(count)).cwiseMax(0.0).sum();
}

std::vector<Mode> Projection::modes(std::size_t count) const {
    if (count == 0) {
        return {};
    }
    const auto all = static_cast<Eigen::Index>(nodes_.size());
    const auto kept = Eigen::Map<const Eigen::MatrixXd>(vectors_.data(), all, static_cast<Eigen::Index>(count));
    Eigen::VectorXd decays(all);
    Eigen::VectorXd roots(all);
    for (Eigen::Index i = 0; i < all; ++i) {
        decays(i) = -std::expm1(-nodes_[static_cast<std::size_t>(i)].rate);
        roots(i) = nodes_[static_cast<std::size_t>(i)].root;
    }
    const Eigen::MatrixXd compressed = kept.transpose() * decays.asDiagonal() * kept;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(compressed);
    const Eigen::VectorXd projected = solver.eigenvectors().transpose() * (kept.transpose() * roots);
    std::vector<Mode> found;
    for (Eigen::Index m = 0; m < projected.size(); ++m) {
        found.push_back({solver.eigenvalues()(m), projected(m) * projected(m)});
    }
    return found;
}

}  // namespace glsum::design
