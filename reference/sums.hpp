// The oracle: the Grünwald-Letnikov weights and sums in 50 digits, by their definition, slow and obvious.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "glsum/kernel.hpp"
#include "reference/real.hpp"

namespace reference {

/// a_0 ... a_(count-1) of the order, by the recurrence of [Matusiak2020] (3).
[[nodiscard]] std::vector<Real> weights(const Real& order, std::size_t count);

/// a_0 ... a_(count-1) of a design: those that it names, taken as exact, else those of its order, or of another one.
[[nodiscard]] std::vector<Real> weights(const glsum::Design& design, std::size_t count);
[[nodiscard]] std::vector<Real> weights(const glsum::Design& design, const Real& order, std::size_t count);

/// S_k of one length for all k of a record.
using Sums = std::vector<Exact>;

/// The sums of several lengths over one record, in one pass.
/// \param a        weights, at least as many as the longest length or as the record has samples
/// \param lengths  rising; lengths beyond the record give full memory
/// \return         one Sums for each length
[[nodiscard]] std::vector<Sums> sums(std::span<const Real> a, std::span<const double> record,
                                     std::span<const std::size_t> lengths);

/// One sum: sum_j a_j newest_first[j] over as many as both have.
[[nodiscard]] Real sum(std::span<const Real> a, std::span<const double> newest_first);

}  // namespace reference
