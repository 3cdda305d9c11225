#include "gap/drive/slopes.hpp"

#include "gap/drive/cost.hpp"

namespace gap {

std::optional<Slopes> slopes_of(const Study& study, const Candidate& candidate, const std::vector<FreeParameter*>& free,
                                const Whitener* whitener) {
    Cost cost(study, candidate, false, all_of(free), whitener);
    std::vector<double> values;
    for (const FreeParameter* parameter : free) {
        values.push_back(parameter->value / parameter->scale);
    }
    const auto rows = static_cast<Eigen::Index>(cost.num_residuals());
    const auto columns = static_cast<Eigen::Index>(free.size());
    Slopes slopes{Eigen::VectorXd(rows), {}};
    slopes.by_number.setZero(rows, columns);
    const double* parameters = values.data();
    double* jacobian = slopes.by_number.data();
    if (!cost.Evaluate(&parameters, slopes.residuals.data(), &jacobian)) {
        return std::nullopt;
    }
    return slopes;
}

}  // namespace gap
