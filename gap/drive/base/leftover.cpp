#include "gap/drive/base/leftover.hpp"

#include <Eigen/QR>
#include <cmath>

namespace gap {

Leftover leftover_of(const drive::Model& model, const std::vector<Course>& courses, bool driven) {
    Eigen::Index rows = 0;
    for (const Course& course : courses) {
        rows += static_cast<Eigen::Index>(course.record().size());
    }
    const bool steady = drive::constant_coefficient(model.denominator) != 0.0;
    Scenario released;
    released.model = model;
    released.model.gain = 0.0;
    std::vector<Scenario> own;  // of each record
    own.push_back(released);
    own.back().initial_output = 1.0;
    if (drive::highest_order(model.denominator) > 1.0) {
        own.push_back(released);
        own.back().initial_velocity = 1.0;
    }
    if (!steady) {
        own.push_back(released);
        own.back().forces.bias = 1.0;
    }
    const Eigen::Index shared = driven ? 1 : 0;
    const auto of_each = static_cast<Eigen::Index>(own.size()) + (steady ? 1 : 0);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, shared + of_each * static_cast<Eigen::Index>(courses.size()));
    Eigen::VectorXd right(rows);
    Eigen::Index row = 0;
    Eigen::Index column = shared;
    for (const Course& course : courses) {
        const auto size = static_cast<Eigen::Index>(course.record().size());
        const auto put = [&](Eigen::Index at, const Scenario& scenario) {
            const std::vector<double> response = simulate(scenario, course);
            matrix.block(row, at, size, 1) = Eigen::Map<const Eigen::VectorXd>(response.data(), size);
        };
        if (driven) {
            Scenario forced;
            forced.model = model;
            put(0, forced);
        }
        for (const Scenario& one : own) {
            put(column++, one);
        }
        if (steady) {
            matrix.block(row, column++, size, 1).setOnes();
        }
        right.segment(row, size) = Eigen::Map<const Eigen::VectorXd>(course.record().output.data(), size);
        row += size;
    }
    if (!matrix.allFinite()) {
        return {};
    }
    const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve(right);
    const double squares = (matrix * solution - right).squaredNorm();
    if (!std::isfinite(squares) || (driven && solution(0) == 0.0)) {
        return {};
    }
    return {squares, driven ? solution(0) : 1.0};
}

}  // namespace gap
