#include "gap/drive/scan.hpp"

#include <limits>

#include "gap/drive/simulate.hpp"

namespace gap {

std::vector<double> best_of(const Clue& clue, const std::vector<std::vector<double>>& candidates,
                            void (*add_to)(Scenario& scenario, std::span<const double> values)) {
    const std::vector<double> without = simulate(clue.scenario, clue.course);
    std::vector<double> best = candidates.front();
    double least = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& values : candidates) {
        Scenario scenario = clue.scenario;
        add_to(scenario, values);
        const std::vector<double> with = simulate(scenario, clue.course);
        double left = 0.0;
        for (std::size_t i = 0; i < with.size(); ++i) {
            const double residual = clue.residuals[i] - (with[i] - without[i]);
            left += residual * residual;
        }
        if (left < least) {
            least = left;
            best = values;
        }
    }
    return best;
}

}  // namespace gap
