#include "drive/closed_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "drive/swings.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

// Held responses at t_k - t_j, j < k, as the columns of a matrix: a part of one table where the stamps are even.
class Lags {
public:
    using Columns = Eigen::Map<const Eigen::MatrixXd>;

    Lags(InverseLaplace& response, std::size_t functions, std::span<const double> time_s, double delay_s)
        : response_(response), functions_(functions), time_s_(time_s), delay_s_(delay_s) {
        const std::size_t count = time_s.size();
        const double step_s = time_s.back() / static_cast<double>(count - 1);
        for (double k = 0.0; const double stamp_s : time_s) {
            even_ = even_ && std::fabs(stamp_s - k * step_s) < 1e-7 * step_s;
            k += 1.0;
        }
        table_.resize(count * functions_);
        for (std::size_t k = 0; even_ && k < count; ++k) {
            fill(count - 1 - k, static_cast<double>(k) * step_s);  // the longest lag first
        }
    }
    /// Valid until the next call.
    Columns before(std::size_t k) {
        const std::size_t first = even_ ? time_s_.size() - 1 - k : 0;
        for (std::size_t j = 0; !even_ && j < k; ++j) {
            fill(j, time_s_[k] - time_s_[j]);
        }
        return {table_.data() + first * functions_, static_cast<Eigen::Index>(functions_),
                static_cast<Eigen::Index>(k)};
    }

private:
    void fill(std::size_t column, double lag_s) {
        response_.at(lag_s - delay_s_, std::span(table_).subspan(column * functions_, functions_));
    }

    InverseLaplace& response_;
    std::size_t functions_;
    std::span<const double> time_s_;
    double delay_s_;
    bool even_ = true;
    std::vector<double> table_;
};

InverseLaplace step_of(const Model& model) {
    return {1,
            [model](std::complex<double> s, std::span<std::complex<double>> values) {
                values[0] = evaluate_without_delay(model, s) / s;
            },
            swings_of(model.denominator)};
}

}  // namespace

LoopRun run_loop(InverseLaplace& plant, std::size_t functions, double delay_s, const Model& controller,
                 std::span<const double> time_s, std::span<const double> reference, double offset,
                 std::span<const double> disturbance, const std::optional<Sensitivity>& sensitivity) {
    const std::size_t count = time_s.size();
    if (count > most_loop_samples) {
        refuse(fmt::format("a closed loop: expected at most {} samples, found {}; resample the log", most_loop_samples,
                           count));
    }
    InverseLaplace own = step_of(controller);
    Lags plant_lags(plant, functions, time_s, delay_s);
    Lags controller_lags(own, 1, time_s, controller.delay_s);
    const double direct = direct_gain(controller);
    const auto parameters = sensitivity ? sensitivity->chain->cols() : 0;
    const auto numbers = static_cast<Eigen::Index>(functions) - 1;
    const auto rows = static_cast<Eigen::Index>(count);
    LoopRun run;
    run.output.resize(count);
    run.input.resize(count);
    // Changes of error and input at each stamp; of their sensitivities a column for each stamp.
    Eigen::VectorXd error_change(rows);
    Eigen::VectorXd input_change(rows);
    Eigen::MatrixXd error_changes(parameters, rows);
    Eigen::MatrixXd input_changes(parameters, rows);
    Eigen::VectorXd error_before = Eigen::VectorXd::Zero(parameters);
    Eigen::VectorXd input_before = Eigen::VectorXd::Zero(parameters);
    if (sensitivity) {
        run.sensitivities.resize(rows, parameters);
    }
    double error = 0.0;
    double input = 0.0;
    for (Eigen::Index k = 0; k < rows; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const Lags::Columns plant_before = plant_lags.before(at);
        const double output = plant_before.row(0).dot(input_change.head(k));
        run.output[at] = output;
        const double reading = output + offset + (disturbance.empty() ? 0.0 : disturbance[at]);
        const double error_now = reference[at] - reading;
        error_change(k) = error_now - error;
        error = error_now;
        const Lags::Columns controller_before = controller_lags.before(at);
        const double input_now = controller_before.row(0).dot(error_change.head(k)) + direct * error_change(k);
        run.input[at] = input_now;
        input_change(k) = input_now - input;
        input = input_now;
        if (sensitivity) {
            // The model's own change, and what its input did differently before.
            Eigen::VectorXd outputs =
                sensitivity->chain->transpose() * (plant_before.bottomRows(numbers) * input_change.head(k));
            outputs += input_changes.leftCols(k) * plant_before.row(0).transpose();
            run.sensitivities.row(k) = outputs.transpose();
            if (sensitivity->offset_column >= 0) {
                outputs(sensitivity->offset_column) += 1.0;
            }
            error_changes.col(k) = -outputs - error_before;
            error_before = -outputs;
            const Eigen::VectorXd inputs =
                error_changes.leftCols(k) * controller_before.row(0).transpose() + direct * error_changes.col(k);
            input_changes.col(k) = inputs - input_before;
            input_before = inputs;
        }
        if (!(std::fabs(output) < 1e30)) {
            throw glsum::Failure(glsum::Exit::check_failed,
                                 fmt::format("the closed loop runs away by {} s: it is unstable", time_s[at]));
        }
    }
    return run;
}

LoopRun run_loop(const Model& plant, const Model& controller, std::span<const double> time_s,
                 std::span<const double> reference, double offset, std::span<const double> disturbance) {
    InverseLaplace step = step_of(plant);
    return run_loop(step, 1, plant.delay_s, controller, time_s, reference, offset, disturbance, std::nullopt);
}

std::vector<double> recover_reference(const Model& controller, std::span<const double> time_s,
                                      std::span<const double> input, std::span<const double> output) {
    const double direct = direct_gain(controller);
    if (direct == 0.0) {
        refuse(
            "the controller does not answer an error at once, so that the log's input does not tell its reference: "
            "expected a column reference");
    }
    if (time_s.size() > most_loop_samples) {
        refuse(fmt::format("a closed loop: expected at most {} samples, found {}; resample the log", most_loop_samples,
                           time_s.size()));
    }
    InverseLaplace own = step_of(controller);
    Lags lags(own, 1, time_s, controller.delay_s);
    Eigen::VectorXd change(static_cast<Eigen::Index>(time_s.size()));
    std::vector<double> reference;
    double error = 0.0;
    for (std::size_t k = 0; k < time_s.size(); ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        change(at) = (input[k] - lags.before(k).row(0).dot(change.head(at))) / direct;
        error += change(at);
        reference.push_back(output[k] + error);
    }
    return reference;
}

}  // namespace drive
