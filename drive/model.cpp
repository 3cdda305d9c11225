#include "drive/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/failure.hpp"

namespace drive {
namespace {

constexpr double highest_accepted_order = 20.0;
constexpr double longest_delay_s = 1e6;
constexpr std::size_t most_terms = 64;

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

const Term& leading(const std::vector<Term>& terms) {
    return *std::max_element(terms.begin(), terms.end(),
                             [](const Term& a, const Term& b) { return a.order < b.order; });
}

void check_terms(const std::vector<Term>& terms, const std::string& name) {
    if (terms.empty() || terms.size() > most_terms) {
        refuse(fmt::format("{}: expected 1 to {} terms, found {}", name, most_terms, terms.size()));
    }
    for (std::size_t i = 0; i < terms.size(); ++i) {
        if (!std::isfinite(terms[i].coefficient)) {
            refuse(
                fmt::format("{}[{}].coefficient: expected a finite number, found {}", name, i, terms[i].coefficient));
        }
        if (!(terms[i].order >= 0.0 && terms[i].order <= highest_accepted_order)) {
            refuse(fmt::format("{}[{}].order: expected 0 to {}, found {}", name, i, highest_accepted_order,
                               terms[i].order));
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (terms[j].order == terms[i].order) {
                refuse(fmt::format("{}[{}].order: expected each order once, found {} again", name, i, terms[i].order));
            }
        }
    }
    if (leading(terms).coefficient == 0.0) {
        refuse(fmt::format("{}: the coefficient of the highest order, {}, is 0: leave that term out", name,
                           leading(terms).order));
    }
}

std::string to_text(const std::vector<Term>& terms) {
    std::vector<Term> falling = terms;
    std::sort(falling.begin(), falling.end(), [](const Term& a, const Term& b) { return a.order > b.order; });
    std::string text;
    for (const Term& term : falling) {
        const std::string sign = text.empty()           ? (term.coefficient < 0 ? "-" : "")
                                 : term.coefficient < 0 ? " - "
                                                        : " + ";
        const double size = std::fabs(term.coefficient);
        if (term.order == 0.0) {
            text += fmt::format("{}{}", sign, size);
        } else {
            const std::string power = term.order == 1.0 ? "s" : fmt::format("s^{}", term.order);
            text += size == 1.0 ? sign + power : fmt::format("{}{} {}", sign, size, power);
        }
    }
    return terms.size() == 1 ? text : "(" + text + ")";
}

}  // namespace

Model make_fopdt(double gain, double time_constant_s, double delay_s) {
    Model model;
    model.kind = Kind::fopdt;
    model.gain = gain;
    model.denominator = {{time_constant_s, 1.0}, {1.0, 0.0}};
    model.delay_s = delay_s;
    return model;
}

Model make_sopdt(double gain, double time_constant_s, double delay_s) {
    Model model = make_fopdt(gain, time_constant_s, delay_s);
    model.kind = Kind::sopdt;
    model.denominator = {{time_constant_s * time_constant_s, 2.0}, {2.0 * time_constant_s, 1.0}, {1.0, 0.0}};
    return model;
}

void check_model(const Model& model, const std::string& name) {
    if (!std::isfinite(model.gain) || model.gain == 0.0) {
        refuse(fmt::format("{}: gain: expected a finite number other than 0, found {}", name, model.gain));
    }
    check_terms(model.denominator, name + ": denominator");
    check_terms(model.numerator, name + ": numerator");
    if (highest_order(model.numerator) > highest_order(model.denominator)) {
        refuse(fmt::format("{}: improper: expected a numerator of order up to {}, the denominator's, found {}", name,
                           highest_order(model.denominator), highest_order(model.numerator)));
    }
    if (!(model.delay_s >= 0.0 && model.delay_s <= longest_delay_s)) {
        refuse(fmt::format("{}: delay_s: expected 0 to {} s, found {}", name, longest_delay_s, model.delay_s));
    }
    if (model.sample_time_s && !(*model.sample_time_s > 0.0 && std::isfinite(*model.sample_time_s))) {
        refuse(
            fmt::format("{}: sample_time_s: expected a finite number above 0, found {}", name, *model.sample_time_s));
    }
}

double highest_order(const std::vector<Term>& terms) { return leading(terms).order; }

double leading_coefficient(const std::vector<Term>& terms) { return leading(terms).coefficient; }

double constant_coefficient(const std::vector<Term>& terms) {
    for (const Term& term : terms) {
        if (term.order == 0.0) {
            return term.coefficient;
        }
    }
    return 0.0;
}

double static_gain(const Model& model) {
    const double above = model.gain * constant_coefficient(model.numerator);
    const double below = constant_coefficient(model.denominator);
    if (below == 0.0) {
        return above == 0.0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), above);
    }
    return above / below;
}

std::complex<double> evaluate(const std::vector<Term>& terms, std::complex<double> s) {
    const std::complex<double> logarithm = std::log(s);
    std::complex<double> sum = 0.0;
    for (const Term& term : terms) {
        sum += term.order == 0.0 ? term.coefficient : term.coefficient * std::exp(term.order * logarithm);
    }
    return sum;
}

std::complex<double> evaluate_without_delay(const Model& model, std::complex<double> s) {
    return model.gain * evaluate(model.numerator, s) / evaluate(model.denominator, s);
}

std::string to_text(const Model& model) {
    std::string above = to_text(model.numerator);
    if (model.numerator == std::vector<Term>{{1.0, 0.0}}) {
        above = fmt::format("{}", model.gain);
    } else if (model.gain != 1.0) {
        above = fmt::format("{} {}", model.gain, above);
    }
    return fmt::format("{} / {}{}", above, to_text(model.denominator),
                       model.delay_s == 0.0 ? "" : fmt::format(" exp(-{} s)", model.delay_s));
}

const char* name_of(Kind kind) {
    switch (kind) {
        case Kind::fopdt:
            return "fopdt";
        case Kind::sopdt:
            return "sopdt";
        case Kind::niopdt:
            return "niopdt";
        case Kind::fotf:
            break;
    }
    return "fotf";
}

Kind kind_named(const std::string& name) {
    for (const Kind kind : {Kind::fopdt, Kind::sopdt, Kind::niopdt}) {
        if (name == name_of(kind)) {
            return kind;
        }
    }
    return Kind::fotf;
}

}  // namespace drive
