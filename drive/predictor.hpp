// What a form's parameters predict on records, and how they change it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "drive/form.hpp"
#include "drive/record.hpp"

namespace drive {

[[nodiscard]] std::size_t samples_of(const std::vector<Record>& records);

/// A row a sample, a column a free parameter.
using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Predictor {
public:
    /// Keeps references to both.
    Predictor(const Form& form, const std::vector<Record>& records);
    [[nodiscard]] const std::vector<std::size_t>& free() const { return free_; }  ///< indices of the free parameters
    [[nodiscard]] const std::vector<Record>& records() const { return records_; }
    /// The form's own values, with those of the free parameters in their place.
    [[nodiscard]] std::vector<double> all_values(const double* free_values) const;

    /// \param residuals  modelled - measured, all records in turn  \param jacobian  if wanted, exact
    /// \throws glsum::Failure (bad input) if the values make no model, or one that cannot be simulated
    void evaluate(const double* free_values, Eigen::VectorXd& residuals, Jacobian* jacobian) const;

    /// e_k = r_k + sum c_i r_(k-i) in each record, in place, newest first.
    template <class Matrix>
    void whiten(Matrix& rows, const std::vector<double>& noise_model) const {
        if (noise_model.empty()) {
            return;
        }
        Eigen::Index first = 0;
        for (const Record& record : records_) {
            const auto count = static_cast<Eigen::Index>(record.output.size());
            for (Eigen::Index k = count - 1; k > 0; --k) {
                for (std::size_t i = 0; i < noise_model.size() && k > static_cast<Eigen::Index>(i); ++i) {
                    rows.row(first + k) += noise_model[i] * rows.row(first + k - 1 - static_cast<Eigen::Index>(i));
                }
            }
            first += count;
        }
    }

private:
    const Form& form_;
    const std::vector<Record>& records_;
    std::vector<std::size_t> free_;
};

}  // namespace drive
