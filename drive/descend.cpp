#include "drive/descend.hpp"

#include <algorithm>

#include "base/failure.hpp"
#include "drive/solve.hpp"

namespace drive {
namespace {

class Cost : public ceres::CostFunction {
public:
    Cost(const Predictor& predictor, const std::vector<double>& noise_model)
        : predictor_(predictor), noise_model_(noise_model) {
        set_num_residuals(static_cast<int>(samples_of(predictor.records())));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(predictor.free().size()));
    }

    bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
        try {
            Eigen::VectorXd r;
            Jacobian j;
            const bool wanted = jacobians != nullptr && jacobians[0] != nullptr;
            predictor_.evaluate(parameters[0], r, wanted ? &j : nullptr);
            predictor_.whiten(r, noise_model_);
            std::copy(r.begin(), r.end(), residuals);
            if (wanted) {
                predictor_.whiten(j, noise_model_);
                std::copy(j.data(), j.data() + j.size(), jacobians[0]);
            }
            return true;
        } catch (const glsum::Failure&) {
            return false;  // no model, or one that cannot be simulated: the step is taken back
        }
    }

private:
    const Predictor& predictor_;
    const std::vector<double>& noise_model_;
};

// The first of the stopping rules (9).
class StopWhenAccepted : public ceres::IterationCallback {
public:
    explicit StopWhenAccepted(double accepted) : accepted_(accepted) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
        // Ceres' cost is half the sum of squares.
        return 2.0 * summary.cost <= accepted_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }

private:
    double accepted_;
};

}  // namespace

Attempt descend(const Form& form, const Predictor& predictor, std::vector<double> start,
                const std::vector<double>& noise_model, const Descent& how) {
    ceres::Problem problem;
    problem.AddResidualBlock(new Cost(predictor, noise_model), nullptr, start.data());
    for (std::size_t i = 0; i < start.size(); ++i) {
        const Parameter& parameter = form.parameters()[predictor.free()[i]];
        problem.SetParameterLowerBound(start.data(), static_cast<int>(i), parameter.lower);
        problem.SetParameterUpperBound(start.data(), static_cast<int>(i), parameter.upper);
    }
    ceres::Solver::Options solver;
    solver.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
    solver.linear_solver_type = ceres::DENSE_QR;
    solver.max_num_iterations = how.iterations;
    solver.function_tolerance = how.tolerance;
    solver.parameter_tolerance = 1e-10;
    solver.gradient_tolerance = 1e-14;
    StopWhenAccepted accepted(how.accepted_error);
    if (how.accepted_error > 0.0) {
        solver.callbacks.push_back(&accepted);
    }
    const ceres::Solver::Summary summary = solve_in_silence(solver, problem);
    Attempt attempt;
    if (summary.IsSolutionUsable()) {
        attempt.values = std::move(start);
        attempt.sum_of_squares = 2.0 * summary.final_cost;
        attempt.iterations = static_cast<int>(summary.iterations.size()) - 1;
        attempt.ended = summary.termination_type != ceres::NO_CONVERGENCE;
        attempt.stopped = summary.termination_type == ceres::USER_SUCCESS ? "the accepted error E_c was reached"
                          : attempt.ended                                 ? "nothing better is near"
                                                                          : "the number of iterations was reached";
    }
    return attempt;
}

}  // namespace drive
