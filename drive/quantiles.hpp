// Quantiles of the distributions that intervals are made of.
#pragma once

namespace drive {

/// Where Student's t of so many degrees of freedom lies below with a probability in (0, 1).
[[nodiscard]] double students_t_quantile(double freedom, double probability);

/// The same for Fisher's F of two degrees of freedom.
[[nodiscard]] double fisher_f_quantile(double numerator_freedom, double denominator_freedom, double probability);

}  // namespace drive
