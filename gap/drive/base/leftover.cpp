#include "gap/drive/base/leftover.hpp"

#include <Eigen/QR>
#include <cmath>

#include "gap/drive/ends.hpp"

namespace gap {
namespace {

// Each record's columns less what they were lately, weighted by how long ago: a high-pass.
void keep_quick(Eigen::MatrixXd& matrix, const std::vector<Course>& courses, double quick_s) {
    Eigen::Index row = 0;
    for (const Course& course : courses) {
        const std::vector<double>& time_s = course.record().time_s;
        Eigen::RowVectorXd lately = matrix.row(row);
        matrix.row(row).setZero();
        for (std::size_t i = 1; i < time_s.size(); ++i) {
            const double left = std::exp(-(time_s[i] - time_s[i - 1]) / quick_s);
            auto now = matrix.row(row + static_cast<Eigen::Index>(i));
            lately = left * lately + (1.0 - left) * now;
            now -= lately;
        }
        row += static_cast<Eigen::Index>(time_s.size());
    }
}

// What is at an end tells nothing of the plant but that it is beyond.
void forget_ends(Eigen::MatrixXd& matrix, const std::vector<Course>& courses) {
    Eigen::Index row = 0;
    for (const Course& course : courses) {
        const auto counts = without_ends({std::vector<char>(course.record().size(), 1)}, {course.record()});
        for (const char count : counts.front()) {
            if (count == 0) {
                matrix.row(row).setZero();
            }
            ++row;
        }
    }
}

Leftover solve(const Eigen::MatrixXd& matrix, bool driven) {
    if (!matrix.allFinite()) {
        return {};
    }
    const auto unknown = matrix.leftCols(matrix.cols() - 1);
    const auto right = matrix.rightCols(1);
    const Eigen::VectorXd solution = unknown.colPivHouseholderQr().solve(right);
    const double squares = (unknown * solution - right).squaredNorm();
    if (!std::isfinite(squares) || (driven && solution(0) == 0.0)) {
        return {};
    }
    return {squares, driven ? solution(0) : 1.0};
}

// A column for each unknown, and the readings in the last.
Eigen::MatrixXd columns_of(const drive::Model& model, const std::vector<Course>& courses, bool driven) {
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
    Eigen::MatrixXd matrix =
        Eigen::MatrixXd::Zero(rows, shared + of_each * static_cast<Eigen::Index>(courses.size()) + 1);
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
        matrix.col(matrix.cols() - 1).segment(row, size) =
            Eigen::Map<const Eigen::VectorXd>(course.record().output.data(), size);
        row += size;
    }
    return matrix;
}

}  // namespace

Leftover leftover_of(const drive::Model& model, const std::vector<Course>& courses, bool driven) {
    Eigen::MatrixXd matrix = columns_of(model, courses, driven);
    forget_ends(matrix, courses);
    return solve(matrix, driven);
}

Leftovers leftovers_of(const drive::Model& model, const std::vector<Course>& courses, bool driven, double quick_s) {
    Eigen::MatrixXd matrix = columns_of(model, courses, driven);
    Eigen::MatrixXd quick = matrix;
    keep_quick(quick, courses, quick_s);
    forget_ends(matrix, courses);
    forget_ends(quick, courses);
    return {solve(matrix, driven), solve(quick, driven)};
}

}  // namespace gap
