#include "gap/drive/clued_start.hpp"

#include <algorithm>
#include <cmath>

namespace gap {

std::vector<FreeParameter> clued_start(const Study& study, const Candidate& without, const Effect& effect) {
    if (effect.start == nullptr) {
        return {};
    }
    const auto longest =
        std::max_element(study.courses.begin(), study.courses.end(),
                         [](const Course& a, const Course& b) { return a.record().size() < b.record().size(); });
    const auto record = static_cast<std::size_t>(longest - study.courses.begin());
    std::vector<double> residuals = residuals_of(study, without, record);
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        if (!std::isfinite(residuals[i])) {
            return {};
        }
        residuals[i] = study.counts[record][i] != 0 ? residuals[i] : 0.0;
    }
    const std::vector<double> values =
        effect.start({*longest, scenario_of(study, without, record), residuals, study.scales});
    std::vector<FreeParameter> parameters = parameters_of(effect, study.scales, 0);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        parameters[i].value = std::clamp(values[i], parameters[i].lower, parameters[i].upper);
    }
    return parameters;
}

}  // namespace gap
