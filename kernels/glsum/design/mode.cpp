#include "glsum/design/mode.hpp"

#include <cmath>

#include "glsum/weights.hpp"

namespace glsum::design {

std::vector<double> weights_to(double order, std::size_t last) {
    std::vector<double> weights = {1.0};
    weights.reserve(last + 1);
    for (Weights walk(order); weights.size() <= last;) {
        walk.next();
        weights.push_back(walk.weight());
    }
    return weights;
}

namespace {

// What has faded adds nothing to weights, of which none within a horizon is below 1e-100. Left to itself it fades on to
// numbers below 1e-308, with which a processor takes ten times as long.
void forget_faded(std::vector<double>& terms) {
    for (double& term : terms) {
        term = std::fabs(term) < 1e-200 ? 0.0 : term;
    }
}

}  // namespace

double error_of(const std::vector<double>& weights, std::size_t near_taps, const std::vector<Mode>& modes,
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
        if (j % 256 == 0) {
            forget_faded(terms);
        }
        error += std::fabs(weights[j] - sum);
    }
    return error;
}

}  // namespace glsum::design
