#include "glsum/design/merged.hpp"

#include <algorithm>
#include <cmath>

#include "glsum/design/bdf.hpp"
#include "glsum/design/fitted.hpp"
#include "glsum/design/projection.hpp"
#include "glsum/weights.hpp"

namespace glsum::design {
namespace {

// (1 - z)^(v-1): the weights of D^v on increments.
std::vector<double> increment_weights(double order, std::size_t horizon) {
    std::vector<double> weights = {1.0};
    weights.reserve(horizon + 1);
    for (Weights walk(order - 1.0); weights.size() <= horizon;) {
        walk.next();
        weights.push_back(walk.weight());
    }
    return weights;
}

}  // namespace

std::vector<double> merged_weights(std::span<const Term> terms, double step_s, Discretisation discretisation,
                                   std::size_t horizon) {
    std::vector<double> merged(horizon + 1, 0.0);
    for (const Term& term : terms) {
        const bool bdf2 = discretisation == Discretisation::bdf2;
        const std::vector<double> weights =
            bdf2 ? bdf_increment_weights(2, term.order, horizon + 1) : increment_weights(term.order, horizon);
        const double scale =
            term.coefficient * (bdf2 ? bdf_first_weight(2, term.order) : 1.0) * std::pow(step_s, -term.order);
        for (std::size_t j = 0; j <= horizon; ++j) {
            merged[j] += scale * weights[j];
        }
    }
    return merged;
}

Approximation approximate_merged(std::span<const Term> terms, double step_s, Discretisation discretisation,
                                 std::size_t horizon, std::size_t near_taps, std::size_t modes) {
    constexpr double fine = 1e-9;
    // The factor of bdf2 mixes each weight with those before it: near ones are no mixture, so poles are chosen for a
    // tail that begins earlier.
    const std::size_t tail_from =
        discretisation == Discretisation::bdf2 ? std::max<std::size_t>(near_taps, 4) - 2 : near_taps;
    std::vector<Node> nodes;
    for (const Term& term : terms) {
        if (std::floor(term.order) == term.order) {
            continue;  // no tail
        }
        const double scale = std::sqrt(std::fabs(term.coefficient) * std::pow(step_s, -term.order));
        for (Node node : tail_nodes(term.order - 1.0, tail_from, horizon, fine)) {
            node.root *= scale;
            nodes.push_back(node);
        }
    }
    const std::vector<double> weights = merged_weights(terms, step_s, discretisation, horizon);
    Approximation found{near_taps, {}, 0.0};
    if (!nodes.empty()) {
        const Projection projection(std::move(nodes), horizon);
        found.modes = projection.modes(std::min(modes, projection.size()));
        fit_weights(found.modes, weights, near_taps);
    }
    found.error = error_of(weights, near_taps, found.modes, INFINITY);
    return found;
}

}  // namespace glsum::design
