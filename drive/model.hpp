// The models: fractional transfer functions with a dead time, [Matusiak2020] (5)-(7), and its three plants (10)-(12).
//
//   G(s) = gain (b_m s^beta_m + ... + b_0 s^beta_0) / (a_n s^alpha_n + ... + a_0 s^alpha_0) exp(-delay_s s)
//
// A model is continuous: its input is held between stamps and zero before the record, its output rests at 0.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace drive {

/// One summand of a polynomial in s: coefficient times s^order, the coefficient in s^order times the output's unit.
struct Term {
    double coefficient;
    double order;
    bool operator==(const Term&) const = default;
};

/// How a model file writes it; all four are the same transfer function inside.
enum class Kind { fotf, fopdt, sopdt, niopdt };

struct Model {
    Kind kind = Kind::fotf;
    double gain = 1.0;
    std::vector<Term> numerator{{1.0, 0.0}};
    std::vector<Term> denominator;
    double delay_s = 0.0;
    std::optional<double> sample_time_s;  ///< what was deployed; says nothing about the model
    std::string notes;                    ///< the file's further fields, as JSON, handed through
    bool operator==(const Model&) const = default;
};

/// First order plus dead time (10): gain / (1 + time_constant_s s).
[[nodiscard]] Model make_fopdt(double gain, double time_constant_s, double delay_s);
/// Second order plus dead time (11): gain / (1 + time_constant_s s)^2.
[[nodiscard]] Model make_sopdt(double gain, double time_constant_s, double delay_s);

/// \throws glsum::Failure (bad input) unless the model is one that can be simulated: finite numbers, gain and leading
/// coefficients other than 0, orders of 0 to 20, none twice, proper (no more derivatives of the input than of the
/// output), a delay of 0 to 10^6 s. \param name  begins the message
void check_model(const Model& model, const std::string& name);

[[nodiscard]] double highest_order(const std::vector<Term>& terms);
/// The coefficient of the highest order.
[[nodiscard]] double leading_coefficient(const std::vector<Term>& terms);
/// The coefficient of s^0; 0 where there is none.
[[nodiscard]] double constant_coefficient(const std::vector<Term>& terms);

/// The steady output for a unit input; infinite for an integrating model.
[[nodiscard]] double static_gain(const Model& model);

/// sum c s^order on the principal sheet, |arg s| <= pi; s other than 0.
[[nodiscard]] std::complex<double> evaluate(const std::vector<Term>& terms, std::complex<double> s);
/// G(s) without its dead time.
[[nodiscard]] std::complex<double> evaluate_without_delay(const Model& model, std::complex<double> s);

/// The transfer function on one line, for people: `1 / (0.18234 s^1.9909 + 0.65536 s^0.98319 + 0.9992) exp(-1 s)`.
[[nodiscard]] std::string to_text(const Model& model);

[[nodiscard]] const char* name_of(Kind kind);
/// The kind of this name; `fotf` for any other.
[[nodiscard]] Kind kind_named(const std::string& name);

}  // namespace drive
