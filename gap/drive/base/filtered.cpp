#include "gap/drive/base/filtered.hpp"

#include <Eigen/QR>
#include <cmath>

#include "gap/drive/base/even.hpp"

namespace gap {
namespace {

constexpr int filters = 7;
constexpr int delays = 9;

// The stages L^0 x .. L^n x of L = 1 / (1 + filter_s s), a column each, from rest.
Eigen::MatrixXd stages_of(const Eigen::VectorXd& values, double step_s, double filter_s, int order, bool held) {
    const double left = std::exp(-step_s / filter_s);
    const double ramp = -std::expm1(-step_s / filter_s) / (step_s / filter_s);
    Eigen::MatrixXd stages(values.size(), order + 1);
    stages.col(0) = values;
    for (int stage = 1; stage <= order; ++stage) {
        double at = 0.0;
        stages(0, stage) = 0.0;
        for (Eigen::Index k = 1; k < values.size(); ++k) {
            const double from = stages(k - 1, stage - 1);
            // Held, or straight between samples: exact for the first stage.
            const double to = held && stage == 1 ? from : stages(k, stage - 1);
            at = at * left + from * (ramp - left) + to * (1.0 - ramp);
            stages(k, stage) = at;
        }
    }
    return stages;
}

// (filter_s s)^power L^order = (1 - L)^power L^(order - power), over filter_s^power.
Eigen::VectorXd derivative_of(const Eigen::MatrixXd& stages, int power, double filter_s) {
    const auto order = static_cast<int>(stages.cols()) - 1;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(stages.rows());
    double binomial = 1.0;
    for (int k = 0; k <= power; ++k) {
        sum += (k % 2 == 0 ? binomial : -binomial) * stages.col(order - power + k);
        binomial = binomial * (power - k) / (k + 1);
    }
    return sum / std::pow(filter_s, power);
}

// Stages of the records' inputs and outputs under one filter.
struct Filtered {
    double filter_s;
    std::vector<Eigen::MatrixXd> output;
};

bool solve(const Structure& structure, const std::vector<Even>& records, const Filtered& filtered, double delay_s,
           bool driven, Coefficients& found) {
    Eigen::Index rows = 0;
    for (const Even& record : records) {
        rows += record.output.size();
    }
    const Eigen::Index lags = structure.order - structure.integrators;
    const Eigen::Index of_input = driven ? 1 + structure.zeros : 0;
    const Eigen::Index own = 1 + structure.order;
    Eigen::MatrixXd matrix =
        Eigen::MatrixXd::Zero(rows, lags + of_input + own * static_cast<Eigen::Index>(records.size()));
    Eigen::VectorXd right(rows);
    Eigen::Index row = 0;
    for (std::size_t r = 0; r < records.size(); ++r) {
        const Even& record = records[r];
        const Eigen::Index size = record.output.size();
        right.segment(row, size) = derivative_of(filtered.output[r], structure.integrators, filtered.filter_s);
        for (Eigen::Index i = 0; i < lags; ++i) {
            matrix.block(row, i, size, 1) =
                -derivative_of(filtered.output[r], structure.integrators + static_cast<int>(i) + 1, filtered.filter_s);
        }
        if (driven) {
            const auto by = static_cast<Eigen::Index>(std::lround(delay_s / record.step_s));
            const Eigen::MatrixXd input =
                stages_of(late(record.input, by), record.step_s, filtered.filter_s, structure.order, true);
            for (Eigen::Index j = 0; j < of_input; ++j) {
                matrix.block(row, lags + j, size, 1) = derivative_of(input, static_cast<int>(j), filtered.filter_s);
            }
        }
        const Eigen::Index from = lags + of_input + own * static_cast<Eigen::Index>(r);
        for (Eigen::Index k = 0; k < size; ++k) {
            const double t = static_cast<double>(k) * record.step_s / filtered.filter_s;
            matrix(row + k, from) = 1.0;
            for (int power = 0; power < structure.order; ++power) {
                matrix(row + k, from + 1 + power) = std::pow(t, power) * std::exp(-t);
            }
        }
        row += size;
    }
    if (!matrix.allFinite()) {
        return false;
    }
    const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve(right);
    if (!solution.allFinite() || (driven && solution(lags) == 0.0)) {
        return false;
    }
    found.delay_s = delay_s;
    found.gain = driven ? solution(lags) : 1.0;
    for (Eigen::Index i = 0; i < lags; ++i) {
        if (!(solution(i) > 0.0)) {
            return false;
        }
        found.denominator.push_back(solution(i));
    }
    for (Eigen::Index j = 1; j < of_input; ++j) {
        found.numerator.push_back(solution(lags + j) / found.gain);
    }
    return true;
}

}  // namespace

std::vector<Coefficients> filtered_estimates(const Structure& structure, const std::vector<Record>& records,
                                             bool driven) {
    std::vector<Even> even;
    double length_s = 0.0;
    for (const Record& record : records) {
        even.push_back(even_of(record));
        length_s = std::max(length_s, even.back().length_s);
    }
    const double step_s = even.front().step_s;
    std::vector<Coefficients> all;
    for (int f = 0; f < filters; ++f) {
        const double slowest_s = 0.1 * length_s;
        Filtered filtered{slowest_s * std::pow(2.0 * step_s / slowest_s, static_cast<double>(f) / (filters - 1)), {}};
        for (const Even& record : even) {
            // About its first reading, so that what the filter had not seen is small.
            const Eigen::VectorXd moved = record.output.array() - record.output(0);
            filtered.output.push_back(stages_of(moved, record.step_s, filtered.filter_s, structure.order, false));
        }
        for (int d = 0; d < (driven ? delays : 1); ++d) {
            const double delay_s =
                d == 0 ? 0.0 : step_s * std::pow(0.2 * length_s / step_s, static_cast<double>(d - 1) / (delays - 2));
            if (Coefficients found; solve(structure, even, filtered, delay_s, driven, found)) {
                all.push_back(std::move(found));
            }
        }
    }
    return all;
}

}  // namespace gap
