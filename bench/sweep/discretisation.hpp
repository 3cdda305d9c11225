// How the derivative is discretised: which weights the kernels of a sweep sum, and what the sum stands for.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bench {

/// The sum S_k = sum_j a_j x_(k-j), a_0 = 1, stands for w_0^-1 h^v D^v x(t_k - lag h).
enum class Discretisation {
    gl,       ///< Grünwald-Letnikov's weights: first order in h; w_0 = 1, no lag
    shifted,  ///< the same weights, but at t_k - v h / 2: second order
    bdf2,     ///< of the backward differentiation formula of 2 steps, to the power v (modes/bdf.hpp): order 2
    bdf3,     ///< of 3 steps
    bdf4,     ///< of 4 steps
};

/// By their places in the enumeration: what `--weights` and a result file's context say.
inline constexpr std::array<std::string_view, 5> discretisation_names = {"gl", "shifted", "bdf2", "bdf3", "bdf4"};
[[nodiscard]] std::string_view to_text(Discretisation discretisation);
[[nodiscard]] std::optional<Discretisation> parse_discretisation(std::string_view text);

/// Whether its weights are not those of the order, so that a design must name them.
[[nodiscard]] bool names_weights(Discretisation discretisation);

/// p of bdf<p>; 0 for the others.
[[nodiscard]] unsigned steps_of(Discretisation discretisation);

/// w_0, rounded to double.
[[nodiscard]] double rounded_first_weight(Discretisation discretisation, double order);

/// a_1 ... a_count of one that names its weights, as a design has them; over increments a_0 + ... + a_j instead.
/// \throws std::out_of_range for one that names none
[[nodiscard]] std::vector<double> named_weights(Discretisation discretisation, double order, bool of_increments,
                                                std::size_t count);

/// Why a kernel cannot sum a discretisation's weights; empty where it can, and for what is no kernel.
[[nodiscard]] std::string why_not_served(const std::string& kernel, Discretisation discretisation);

}  // namespace bench
