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
        error += std::fabs(weights[j] - sum);
    }
    return error;
}

}  // namespace glsum::design
