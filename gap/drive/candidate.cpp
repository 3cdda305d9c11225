#include "gap/drive/candidate.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "qemu/failure.hpp"

namespace gap {
namespace {

FreeParameter to_free(const std::string& name, double value, double lower, double upper, double scale) {
    return {name, std::clamp(value, lower, upper), lower, upper, scale};
}

std::vector<FreeParameter> base_of(const Study& study) {
    std::vector<FreeParameter> free;
    if (!study.base.refit) {
        return free;
    }
    for (const drive::Parameter& parameter : study.base.form.parameters()) {
        if (!parameter.fixed && parameter.name != "offset") {
            const double size = std::max(std::fabs(parameter.value), 1e-3);
            // Far enough to reach any sensible value, not so far that a step leaves all sense.
            const double lower =
                parameter.name == "delay_s" ? 0.0 : std::max(parameter.lower, parameter.value - 30.0 * size);
            const double upper = std::min(parameter.upper, parameter.value + 30.0 * size);
            const double scale = parameter.name == "delay_s" ? std::max(size, study.scales.time_constant_s) : size;
            free.push_back(to_free(parameter.name, parameter.value, lower, std::max(upper, lower + 1e-9), scale));
        }
    }
    return free;
}

std::vector<FreeParameter> state_of(const Study& study, const Record& record) {
    if (!study.base.initial_state) {
        return {};
    }
    const double span = study.scales.output_span;
    const double first = record.output.front();
    const double speed = study.scales.speed_max;
    return {to_free("offset", 0.0, -1e6 * span - std::fabs(first), 1e6 * span + std::fabs(first), span),
            to_free("initial_output", first, first - 3.0 * span, first + 3.0 * span, span),
            to_free("initial_velocity", 0.0, -3.0 * speed, 3.0 * speed, speed)};
}

std::vector<FreeParameter> effect_free(const Effect& effect, const Scales& scales, std::size_t start) {
    std::vector<FreeParameter> free;
    for (const EffectParameter& parameter : effect.parameters(scales)) {
        if (parameter.lower == parameter.upper) {
            continue;
        }
        const double value = parameter.starts[start % parameter.starts.size()];
        free.push_back(
            to_free(effect.name + "." + parameter.name, value, parameter.lower, parameter.upper,
                    std::max(std::fabs(value - parameter.none), 0.02 * (parameter.upper - parameter.lower))));
    }
    return free;
}

std::size_t starts_of(const Effect& effect, const Scales& scales) {
    std::size_t most = 1;
    for (const EffectParameter& parameter : effect.parameters(scales)) {
        most = std::max(most, parameter.starts.size());
    }
    return most;
}

// All values of an effect, those included that cannot move.
std::vector<double> values_of(const Effect& effect, const Scales& scales, const FreeParameter*& next) {
    std::vector<double> values;
    for (const EffectParameter& parameter : effect.parameters(scales)) {
        values.push_back(parameter.lower == parameter.upper ? parameter.lower : (next++)->value);
    }
    return values;
}

std::vector<FreeParameter*> pointers(Candidate& candidate, bool own_only) {
    std::vector<FreeParameter*> all;
    const auto add = [&](std::vector<FreeParameter>& list) {
        for (FreeParameter& parameter : list) {
            all.push_back(&parameter);
        }
    };
    if (!own_only) {
        add(candidate.base);
        for (auto& list : candidate.lasting) {
            add(list);
        }
    }
    for (auto& list : candidate.own) {
        add(list);
    }
    return all;
}

// Residuals of a record as they count.
std::vector<double> counted(const Study& study, const Candidate& candidate, std::size_t record,
                            const Whitener* whitener) {
    std::vector<double> residuals = residuals_of(study, candidate, record);
    if (whitener != nullptr) {
        residuals = whitener->apply(residuals);
    }
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        residuals[i] = study.counts[record][i] != 0 ? residuals[i] : 0.0;
    }
    return residuals;
}

// Residuals of all records in units that make them comparable, and their differences by each free number.
class Cost : public ceres::CostFunction {
public:
    Cost(const Study& study, Candidate candidate, bool own_only, const Whitener* whitener)
        : study_(study), candidate_(std::move(candidate)), own_only_(own_only), whitener_(whitener) {
        int rows = 0;
        for (const Course& course : study.courses) {
            rows += static_cast<int>(course.record().size());
        }
        set_num_residuals(rows);
        mutable_parameter_block_sizes()->push_back(static_cast<int>(pointers(candidate_, own_only).size()));
    }

    bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
        Candidate here = candidate_;
        const std::vector<FreeParameter*> free = pointers(here, own_only_);
        for (std::size_t i = 0; i < free.size(); ++i) {
            free[i]->value = parameters[0][i] * free[i]->scale;
        }
        std::vector<std::vector<double>> now;
        std::size_t row = 0;
        for (std::size_t r = 0; r < study_.courses.size(); ++r) {
            now.push_back(counted(study_, here, r, whitener_));
            for (const double value : now.back()) {
                if (!std::isfinite(value)) {
                    return false;
                }
                residuals[row++] = value;
            }
        }
        if (jacobians == nullptr || jacobians[0] == nullptr) {
            return true;
        }
        const std::size_t columns = free.size();
        std::fill(jacobians[0], jacobians[0] + row * columns, 0.0);
        std::size_t shared = 0;
        if (!own_only_) {
            shared = here.base.size();
            for (const auto& list : here.lasting) {
                shared += list.size();
            }
        }
        std::vector<std::size_t> owner(columns, study_.courses.size());
        std::size_t column = shared;
        for (std::size_t r = 0; r < here.own.size(); ++r) {
            for (std::size_t i = 0; i < here.own[r].size(); ++i) {
                owner[column++] = r;
            }
        }
        for (std::size_t p = 0; p < columns; ++p) {
            const double value = free[p]->value;
            double by = 3e-4 * free[p]->scale;
            if (value + by > free[p]->upper) {
                by = -by;
            }
            free[p]->value = value + by;
            row = 0;
            for (std::size_t r = 0; r < study_.courses.size(); ++r) {
                if (p >= shared && owner[p] != r) {
                    row += now[r].size();
                    continue;
                }
                const std::vector<double> moved = counted(study_, here, r, whitener_);
                for (std::size_t k = 0; k < moved.size(); ++k, ++row) {
                    const double slope = (moved[k] - now[r][k]) / (by / free[p]->scale);
                    if (!std::isfinite(slope)) {
                        return false;
                    }
                    jacobians[0][row * columns + p] = slope;
                }
            }
            free[p]->value = value;
        }
        return true;
    }

private:
    const Study& study_;
    Candidate candidate_;
    bool own_only_;
    const Whitener* whitener_;
};

double cost_of(const Study& study, const Candidate& candidate, const Whitener* whitener) {
    double cost = 0.0;
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        for (const double value : counted(study, candidate, r, whitener)) {
            cost += 0.5 * value * value;
        }
    }
    return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

void descend(const Study& study, Candidate& candidate, bool own_only, const Whitener* whitener, int iterations) {
    std::vector<FreeParameter*> free = pointers(candidate, own_only);
    if (free.empty() || !std::isfinite(cost_of(study, candidate, whitener))) {
        candidate.cost = cost_of(study, candidate, whitener);
        return;
    }
    std::vector<double> values;
    for (const FreeParameter* parameter : free) {
        values.push_back(parameter->value / parameter->scale);
    }
    ceres::Problem problem;
    problem.AddResidualBlock(new Cost(study, candidate, own_only, whitener), nullptr, values.data());
    for (std::size_t i = 0; i < free.size(); ++i) {
        problem.SetParameterLowerBound(values.data(), static_cast<int>(i), free[i]->lower / free[i]->scale);
        problem.SetParameterUpperBound(values.data(), static_cast<int>(i), free[i]->upper / free[i]->scale);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = iterations;
    options.function_tolerance = 1e-7;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (summary.IsSolutionUsable()) {
        for (std::size_t i = 0; i < free.size(); ++i) {
            free[i]->value = values[i] * free[i]->scale;
        }
    }
    candidate.cost = cost_of(study, candidate, whitener);
}

// Own numbers of each record: the initial state, then those of the events.
std::vector<FreeParameter> own_of(const Study& study, const Record& record, const std::vector<const Effect*>& effects,
                                  const std::vector<std::size_t>& starts) {
    std::vector<FreeParameter> own = state_of(study, record);
    for (std::size_t e = 0; e < effects.size(); ++e) {
        if (effects[e]->kind == Kind::event) {
            const auto more = effect_free(*effects[e], study.scales, starts[e]);
            own.insert(own.end(), more.begin(), more.end());
        }
    }
    return own;
}

}  // namespace

std::string Candidate::name() const {
    std::string joined;
    for (const Effect* effect : effects) {
        joined += (joined.empty() ? "" : " + ") + effect->name;
    }
    return joined.empty() ? "none" : joined;
}

std::size_t Candidate::parameter_count() const {
    std::size_t count = base.size();
    for (const auto* lists : {&lasting, &own}) {
        for (const auto& list : *lists) {
            count += list.size();
        }
    }
    return count;
}

Scenario scenario_of(const Study& study, const Candidate& candidate, std::size_t record) {
    std::vector<double> values;
    for (const drive::Parameter& parameter : study.base.form.parameters()) {
        values.push_back(parameter.value);
    }
    std::size_t next_base = 0;
    if (study.base.refit) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const drive::Parameter& parameter = study.base.form.parameters()[i];
            if (!parameter.fixed && parameter.name != "offset") {
                values[i] = candidate.base[next_base++].value;
            }
        }
    }
    Scenario scenario;
    scenario.model = study.base.form.to_model(values);
    const FreeParameter* own = candidate.own[record].data();
    if (study.base.initial_state) {
        scenario.offset = (own++)->value;
        // The first reading is where it rests, whatever the offset is.
        scenario.initial_output = (own++)->value - scenario.offset;
        scenario.initial_velocity = (own++)->value;
    }
    std::size_t next_lasting = 0;
    for (const Effect* effect : candidate.effects) {
        if (effect->kind == Kind::event) {
            effect->add_to(scenario, values_of(*effect, study.scales, own));
        } else {
            const FreeParameter* lasting = candidate.lasting[next_lasting++].data();
            effect->add_to(scenario, values_of(*effect, study.scales, lasting));
        }
    }
    return scenario;
}

std::vector<double> residuals_of(const Study& study, const Candidate& candidate, std::size_t record) {
    const Course& course = study.courses[record];
    std::vector<double> residuals = simulate(scenario_of(study, candidate, record), course);
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        residuals[i] = course.record().output[i] - residuals[i];
    }
    return residuals;
}

Candidate fit(const Study& study, const std::vector<const Effect*>& effects, const Candidate& start,
              const Whitener* whitener, std::size_t keep) {
    std::size_t count = 1;
    for (const Effect* effect : effects) {
        count = std::max(count, starts_of(*effect, study.scales));
    }
    std::vector<Candidate> attempts;
    for (std::size_t s = 0; s < count; ++s) {
        Candidate attempt;
        attempt.effects = effects;
        attempt.base = start.base.empty() ? base_of(study) : start.base;
        for (const Effect* effect : effects) {
            if (effect->kind == Kind::lasting) {
                attempt.lasting.push_back(effect_free(*effect, study.scales, s));
            }
        }
        for (std::size_t r = 0; r < study.courses.size(); ++r) {
            attempt.own.push_back(
                own_of(study, study.courses[r].record(), effects, std::vector<std::size_t>(effects.size(), s)));
            if (r < start.own.size() && study.base.initial_state) {
                std::copy_n(start.own[r].begin(), 3, attempt.own[r].begin());
            }
        }
        // What another candidate knows of the same effect is a better start than any.
        std::size_t lasting = 0;
        for (const Effect* effect : effects) {
            if (effect->kind != Kind::lasting) {
                continue;
            }
            std::size_t theirs = 0;
            for (const Effect* known : start.effects) {
                if (known->kind == Kind::lasting) {
                    if (known == effect) {
                        attempt.lasting[lasting] = start.lasting[theirs];
                    }
                    ++theirs;
                }
            }
            ++lasting;
        }
        attempt.cost = cost_of(study, attempt, whitener);
        attempts.push_back(std::move(attempt));
    }
    std::stable_sort(attempts.begin(), attempts.end(),
                     [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    attempts.resize(std::min(keep, attempts.size()));
    for (Candidate& attempt : attempts) {
        descend(study, attempt, false, whitener, 25);
    }
    return *std::min_element(attempts.begin(), attempts.end(),
                             [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
}

void add_deviations(const Study& study, Candidate& candidate, const Whitener& whitener) {
    const std::vector<FreeParameter*> free = pointers(candidate, false);
    if (free.empty()) {
        return;
    }
    Cost cost(study, candidate, false, &whitener);
    std::vector<double> values;
    for (const FreeParameter* parameter : free) {
        values.push_back(parameter->value / parameter->scale);
    }
    const auto rows = static_cast<Eigen::Index>(cost.num_residuals());
    const auto columns = static_cast<Eigen::Index>(free.size());
    Eigen::VectorXd residuals(rows);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> slopes(rows, columns);
    const double* parameters = values.data();
    double* jacobian = slopes.data();
    const bool good = cost.Evaluate(&parameters, residuals.data(), &jacobian);
    const double variance =
        std::max(1.0, residuals.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, rows - columns)));
    const Eigen::MatrixXd information = slopes.transpose() * slopes;
    const Eigen::VectorXd length = information.diagonal().cwiseSqrt();
    const bool all_move = good && (length.array() > 0.0).all();
    Eigen::VectorXd spread = Eigen::VectorXd::Constant(columns, std::numeric_limits<double>::infinity());
    if (all_move) {
        const Eigen::MatrixXd scaled =
            length.cwiseInverse().asDiagonal() * information * length.cwiseInverse().asDiagonal();
        const Eigen::LDLT<Eigen::MatrixXd> factors(scaled);
        if (factors.info() == Eigen::Success && factors.isPositive() && factors.rcond() > 1e-13) {
            const Eigen::MatrixXd inverse = factors.solve(Eigen::MatrixXd::Identity(columns, columns));
            spread = (variance * inverse.diagonal()).cwiseSqrt().cwiseQuotient(length);
        }
    }
    for (Eigen::Index i = 0; i < columns; ++i) {
        free[static_cast<std::size_t>(i)]->deviation = spread(i) * free[static_cast<std::size_t>(i)]->scale;
    }
}

Candidate carried_over(const Study& study, const Candidate& fitted, const Whitener* whitener) {
    std::size_t count = 1;
    for (const Effect* effect : fitted.effects) {
        count = effect->kind == Kind::event ? std::max(count, starts_of(*effect, study.scales)) : count;
    }
    std::vector<Candidate> attempts;
    for (std::size_t s = 0; s < count; ++s) {
        Candidate attempt = fitted;
        attempt.own.clear();
        for (const Course& course : study.courses) {
            attempt.own.push_back(
                own_of(study, course.record(), fitted.effects, std::vector<std::size_t>(fitted.effects.size(), s)));
        }
        descend(study, attempt, true, whitener, 25);
        attempts.push_back(std::move(attempt));
    }
    return *std::min_element(attempts.begin(), attempts.end(),
                             [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
}

}  // namespace gap
