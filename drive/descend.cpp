#include "drive/descend.hpp"

#include <algorithm>
#include <optional>

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
        reached_ = 2.0 * summary.cost <= accepted_;
        return reached_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }
    [[nodiscard]] bool reached() const { return reached_; }

private:
    double accepted_;
    bool reached_ = false;
};

struct Bounds {
    double lower;
    double upper;
    [[nodiscard]] bool hold(double value) const { return value <= lower || value >= upper; }
};

// Ceres cuts a step off at a bound and shortens the rest of it, too: a parameter that is pushed against one makes all
// others creep. Stops where one has stayed at its bound for some steps, so that the others go on without it.
class StopAtABound : public ceres::IterationCallback {
public:
    StopAtABound(const std::vector<double>& values, const std::vector<Bounds>& bounds, const std::vector<int>& held)
        : values_(values), bounds_(bounds), held_(held), stayed_(values.size(), 0) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
        if (summary.iteration == 0 || !summary.step_is_successful) {
            return ceres::SOLVER_CONTINUE;
        }
        for (std::size_t i = 0; i < values_.size(); ++i) {
            stayed_[i] = bounds_[i].hold(values_[i]) ? stayed_[i] + 1 : 0;
            const bool is_held = std::find(held_.begin(), held_.end(), static_cast<int>(i)) != held_.end();
            // Alone, it is where it ends.
            if (stayed_[i] >= long_enough && !is_held && held_.size() + 1 < values_.size()) {
                at_ = static_cast<int>(i);
                return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
            }
        }
        return ceres::SOLVER_CONTINUE;
    }
    [[nodiscard]] std::optional<int> at() const { return at_; }

private:
    static constexpr int long_enough = 3;
    const std::vector<double>& values_;
    const std::vector<Bounds>& bounds_;
    const std::vector<int>& held_;
    std::vector<int> stayed_;
    std::optional<int> at_;
};

// Whether the sum of squares falls from a bound inwards, by more than a part of it.
bool leads_inside(const Eigen::VectorXd& residuals, const Jacobian& jacobian, int i, bool at_lower, double tolerance) {
    const auto column = jacobian.col(i);
    const double slope = column.dot(residuals);
    return (at_lower ? slope < 0.0 : slope > 0.0) &&
           slope * slope > tolerance * residuals.squaredNorm() * column.squaredNorm();
}

}  // namespace

Attempt descend(const Form& form, const Predictor& predictor, std::vector<double> start,
                const std::vector<double>& noise_model, const Descent& how) {
    std::vector<Bounds> bounds;
    for (const std::size_t index : predictor.free()) {
        bounds.push_back({form.parameters()[index].lower, form.parameters()[index].upper});
    }
    std::vector<int> held;
    Attempt attempt;
    constexpr int most_turns = 12;
    for (int turn = 0; turn < most_turns && attempt.iterations < how.iterations; ++turn) {
        ceres::Problem problem;
        problem.AddResidualBlock(new Cost(predictor, noise_model), nullptr, start.data());
        for (std::size_t i = 0; i < start.size(); ++i) {
            problem.SetParameterLowerBound(start.data(), static_cast<int>(i), bounds[i].lower);
            problem.SetParameterUpperBound(start.data(), static_cast<int>(i), bounds[i].upper);
        }
        if (!held.empty()) {
            problem.SetManifold(start.data(), new ceres::SubsetManifold(static_cast<int>(start.size()), held));
        }
        ceres::Solver::Options solver;
        solver.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
        solver.linear_solver_type = ceres::DENSE_QR;
        solver.max_num_iterations = how.iterations - attempt.iterations;
        solver.function_tolerance = how.tolerance;
        solver.parameter_tolerance = 1e-10;
        solver.gradient_tolerance = 1e-14;
        solver.update_state_every_iteration = true;
        StopWhenAccepted accepted(how.accepted_error);
        if (how.accepted_error > 0.0) {
            solver.callbacks.push_back(&accepted);
        }
        StopAtABound bound(start, bounds, held);
        solver.callbacks.push_back(&bound);
        const ceres::Solver::Summary summary = solve_in_silence(solver, problem);
        if (!summary.IsSolutionUsable()) {
            break;
        }
        attempt.values = start;
        attempt.sum_of_squares = 2.0 * summary.final_cost;
        attempt.iterations += static_cast<int>(summary.iterations.size()) - 1;
        attempt.ended = summary.termination_type == ceres::CONVERGENCE || accepted.reached();
        attempt.stopped = accepted.reached() ? "the accepted error E_c was reached"
                          : attempt.ended    ? "nothing better is near"
                                             : "the number of iterations was reached";
        if (bound.at()) {
            held.push_back(*bound.at());
            continue;
        }
        if (!attempt.ended || accepted.reached() || held.empty()) {
            break;
        }
        Eigen::VectorXd residuals;
        Jacobian jacobian;
        try {
            predictor.evaluate(start.data(), residuals, &jacobian);
        } catch (const glsum::Failure&) {
            break;  // what was found stands; a step to one side of it is no model
        }
        predictor.whiten(residuals, noise_model);
        predictor.whiten(jacobian, noise_model);
        const auto free_again = std::erase_if(held, [&](int i) {
            const auto at = static_cast<std::size_t>(i);
            return leads_inside(residuals, jacobian, i, start[at] <= bounds[at].lower, how.tolerance);
        });
        if (free_again == 0) {
            break;
        }
    }
    return attempt;
}

}  // namespace drive
