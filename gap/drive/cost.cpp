#include "gap/drive/cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gap {
namespace {

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

// Another record's own numbers move nothing in this one.
bool moves(const Candidate& candidate, const FreeParameter& parameter, std::size_t record) {
    for (std::size_t r = 0; r < candidate.own.size(); ++r) {
        const auto& list = candidate.own[r];
        if (!list.empty() && &parameter >= list.data() && &parameter < list.data() + list.size()) {
            return r == record;
        }
    }
    return true;
}

}  // namespace

Cost::Cost(const Study& study, Candidate candidate, bool own_only, std::vector<std::size_t> which,
           const Whitener* whitener)
    : study_(study),
      candidate_(std::move(candidate)),
      own_only_(own_only),
      which_(std::move(which)),
      whitener_(whitener) {
    int rows = 0;
    for (const Course& course : study.courses) {
        rows += static_cast<int>(course.record().size());
    }
    set_num_residuals(rows);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(which_.size()));
}

bool Cost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
    Candidate here = candidate_;
    const std::vector<FreeParameter*> all = free_numbers(here, own_only_);
    std::vector<FreeParameter*> free;
    for (const std::size_t i : which_) {
        free.push_back(all[i]);
    }
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
    for (std::size_t p = 0; p < columns; ++p) {
        const double value = free[p]->value;
        double by = 3e-4 * free[p]->scale;
        by = value + by > free[p]->upper ? -by : by;
        free[p]->value = value + by;
        row = 0;
        for (std::size_t r = 0; r < study_.courses.size(); ++r) {
            if (!moves(here, *free[p], r)) {
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

std::vector<std::size_t> all_of(const std::vector<FreeParameter*>& free) {
    std::vector<std::size_t> which(free.size());
    std::iota(which.begin(), which.end(), std::size_t{0});
    return which;
}

double cost_of(const Study& study, const Candidate& candidate, const Whitener* whitener) {
    double cost = 0.0;
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        for (const double value : counted(study, candidate, r, whitener)) {
            cost += 0.5 * value * value;
        }
    }
    return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

}  // namespace gap
