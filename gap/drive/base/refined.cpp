#include "gap/drive/base/refined.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "gap/drive/base/even.hpp"

namespace gap {
namespace {

// 1 / A(s) in the time unit of A's size, where its coefficients are near 1. Its states are the filtered signal and its
// derivatives.
struct Filter {
    double unit_s;
    Eigen::VectorXd coefficients;  // of s^1 upwards, times unit_s to minus their power
    Eigen::MatrixXd rates;         // of the states
};

Filter filter_of(const std::vector<double>& denominator) {
    const auto order = static_cast<Eigen::Index>(denominator.size());
    Filter filter;
    filter.unit_s = std::pow(denominator.back(), 1.0 / static_cast<double>(order));
    filter.coefficients.resize(order);
    filter.rates = Eigen::MatrixXd::Zero(order, order);
    for (Eigen::Index i = 0; i < order; ++i) {
        filter.coefficients(i) =
            denominator[static_cast<std::size_t>(i)] / std::pow(filter.unit_s, static_cast<double>(i + 1));
    }
    for (Eigen::Index i = 0; i + 1 < order; ++i) {
        filter.rates(i, i + 1) = 1.0;
        filter.rates(order - 1, i + 1) = -filter.coefficients(i);
    }
    filter.rates(order - 1, 0) = -1.0;
    return filter;
}

bool is_stable(const Filter& filter) {
    return filter.rates.allFinite() && (filter.rates.eigenvalues().real().array() < 0.0).all();
}

// The signal and its derivatives up to the filter's order, filtered, a column each, from rest. \param held  from each
// sample to the next; else straight between them
Eigen::MatrixXd derivatives_of(const Filter& filter, const Eigen::VectorXd& values, double step_s, bool held) {
    const Eigen::Index order = filter.rates.rows();
    Eigen::MatrixXd with_input = Eigen::MatrixXd::Zero(order + 2, order + 2);
    with_input.topLeftCorner(order, order) = filter.rates;
    with_input(order - 1, order) = 1.0;
    with_input(order, order + 1) = 1.0;
    const Eigen::MatrixXd over_step = (with_input * (step_s / filter.unit_s)).exp();
    const double per_unit = filter.unit_s / step_s;
    Eigen::MatrixXd columns(values.size(), order + 1);
    Eigen::VectorXd states = Eigen::VectorXd::Zero(order + 2);
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        columns.row(k).head(order) = states.head(order);
        // The highest derivative is what the equation leaves of the signal.
        columns(k, order) =
            values(k) - states(0) - filter.coefficients.head(order - 1).dot(states.segment(1, order - 1));
        if (k + 1 < values.size()) {
            states(order) = values(k);
            states(order + 1) = held ? 0.0 : (values(k + 1) - values(k)) * per_unit;
            states = (over_step * states).eval();
        }
    }
    return columns;
}

// What the filter had not seen: its free responses, a column for each state.
Eigen::MatrixXd free_of(const Filter& filter, Eigen::Index size, double step_s) {
    const Eigen::Index order = filter.rates.rows();
    const Eigen::MatrixXd over_step = (filter.rates * (step_s / filter.unit_s)).exp();
    Eigen::MatrixXd columns(size, order);
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Unit(order, 0);
    for (Eigen::Index k = 0; k < size; ++k) {
        columns.row(k) = row;
        row = (row * over_step).eval();
    }
    return columns;
}

std::optional<Coefficients> solve(const Structure& structure, const std::vector<Even>& records, const Filter& filter,
                                  double delay_s) {
    const Eigen::Index order = structure.order;
    const Eigen::Index of_input = 1 + structure.zeros;
    const Eigen::Index own = 1 + order;
    Eigen::Index rows = 0;
    for (const Even& record : records) {
        rows += record.output.size();
    }
    Eigen::MatrixXd matrix =
        Eigen::MatrixXd::Zero(rows, order + of_input + own * static_cast<Eigen::Index>(records.size()));
    Eigen::VectorXd right(rows);
    Eigen::Index row = 0;
    Eigen::Index of_record = order + of_input;
    for (const Even& record : records) {
        const Eigen::Index size = record.output.size();
        const Eigen::VectorXd moved = record.output.array() - record.output(0);
        const Eigen::MatrixXd output = derivatives_of(filter, moved, record.step_s, false);
        const auto by = static_cast<Eigen::Index>(std::lround(delay_s / record.step_s));
        const Eigen::MatrixXd input = derivatives_of(filter, late(record.input, by), record.step_s, true);
        right.segment(row, size) = output.col(0);
        matrix.block(row, 0, size, order) = -output.rightCols(order);
        matrix.block(row, order, size, of_input) = input.leftCols(of_input);
        matrix.block(row, of_record, size, 1).setOnes();
        matrix.block(row, of_record + 1, size, order) = free_of(filter, size, record.step_s);
        row += size;
        of_record += own;
    }
    if (!matrix.allFinite()) {
        return std::nullopt;
    }
    const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve(right);
    if (!solution.allFinite() || solution(order) == 0.0 || !(solution.head(order).array() > 0.0).all()) {
        return std::nullopt;
    }
    Coefficients found;
    found.delay_s = delay_s;
    found.gain = solution(order);
    for (Eigen::Index i = 0; i < order; ++i) {
        found.denominator.push_back(solution(i) * std::pow(filter.unit_s, static_cast<double>(i + 1)));
    }
    for (Eigen::Index j = 1; j < of_input; ++j) {
        found.numerator.push_back(solution(order + j) / found.gain * std::pow(filter.unit_s, static_cast<double>(j)));
    }
    return found;
}

}  // namespace

std::optional<Coefficients> refined(const Structure& structure, const std::vector<Record>& records,
                                    const Coefficients& start) {
    if (structure.integrators > 0 || structure.fractional || !(start.denominator.back() > 0.0)) {
        return std::nullopt;
    }
    std::vector<Even> even;
    for (const Record& record : records) {
        even.push_back(even_of(record));
    }
    constexpr int iterations = 8;
    std::optional<Coefficients> best;
    Filter filter = filter_of(start.denominator);
    for (int i = 0; i < iterations && is_stable(filter); ++i) {
        const std::optional<Coefficients> next = solve(structure, even, filter, start.delay_s);
        if (!next) {
            break;
        }
        best = next;
        filter = filter_of(next->denominator);
    }
    return best;
}

}  // namespace gap
