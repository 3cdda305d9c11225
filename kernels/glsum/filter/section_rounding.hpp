// What a cascade's sections hold of their coefficients, and what that and their arithmetic cost, section by section:
// for `prepare`, which scales q31 by it, and for the bound.
//
// What is made wrong in a section, e a step, passes 1/A, A = 1 + a1 q + a2 q^2 = (1 - p q)(1 - p' q): at most
// N = 1/((1-|p|)(1-|p'|)) of it. What was wrong in its input passes H = B/A, whose l1 norm is 1 + |H(1) - 1| where no
// pole is negative, since its response behind the first sample has one sign; where d > 1, at most d/(2-d) times |H(1) -
// 1| instead of that. So the l1 norm of the whole response up to a section, too, is known from its gain at rest alone.
// With X and Y what input and output reach, computed:
//   coefficients  their own errors, known from the table, times X and Y
//   f32           y: u Y; s1: u (2 |b1| X + 2 |a1| Y + 2 (X+Y) + s2); s2, at most |b2| X + |a2| Y: 2 u of it
//   q31           half a unit, high-passed: (1-q)/A, at most 2/(1-|p|) with the faster p
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "glsum/filter/series.hpp"
#include "glsum/power_of_two.hpp"
#include "glsum/weights.hpp"

namespace glsum {

[[nodiscard]] constexpr double magnitude_of(double real) { return real < 0.0 ? -real : real; }

/// Coefficients as a table holds them, in double.
struct HeldSection {
    double b0;  ///< 2^-t: what the section scales down by
    double b1;
    double b2;
    double a1;
    double a2;

    /// Two real poles inside the circle, or one. With d = 1 - p they are the roots of d^2 - (2 + a1) d + (1 + a1 + a2).
    [[nodiscard]] bool is_stable(bool single) const {
        const double at_rest = 1.0 + a1 + a2;
        const double sum = 2.0 + a1;
        return at_rest > 0.0 && 1.0 - a1 + a2 > 0.0 &&
               (single || (magnitude_of(a2) < 1.0 && sum * sum > 4.0 * at_rest));
    }
};

constexpr int section_bits = 29;  ///< of a q31 coefficient's fraction

/// The second coefficient rounds what the first left of the sum of both: so the response to slow signals, which the sum
/// decides, errs by half a unit of the smaller one alone.
/// \param round  a real to what the format holds of it
template <class Round>
[[nodiscard]] HeldSection hold_section(const Section& section, double scale, bool single, const Round& round) {
    HeldSection held{};
    held.b0 = round(scale);
    held.b1 = round(section.b1 * scale);
    held.b2 = single ? 0.0 : round((section.b1 * scale - held.b1) + section.b2 * scale);
    held.a1 = round(section.a1);
    held.a2 = single ? 0.0 : round((section.a1 - held.a1) + section.a2);
    return held;
}

/// What a format holds of a section that is scaled down by a power of two.
template <class Format>
[[nodiscard]] HeldSection held_of(const Section& section, double scale, bool single) {
    return hold_section(section, scale, single, [](double real) {
        if constexpr (Format::fixed_point) {
            const double whole = real * power_of_two(section_bits);
            return static_cast<double>(static_cast<std::int64_t>(whole < 0.0 ? whole - 0.5 : whole + 0.5)) *
                   power_of_two(-section_bits);
        } else {
            return static_cast<double>(static_cast<typename Format::Coefficient>(real));
        }
    });
}

/// Whether the format has room for these coefficients, and in fixed point for every sum of their products.
template <class Format>
[[nodiscard]] bool fits_format(const HeldSection& held) {
    const double b = magnitude_of(held.b1) + magnitude_of(held.b2);
    const double a = magnitude_of(held.a1) + magnitude_of(held.a2);
    if constexpr (Format::fixed_point) {
        // Each below 4, which 32 bits hold; with what was dropped below a unit all products stay within 64.
        return magnitude_of(held.b1) < 4.0 && magnitude_of(held.b2) < 4.0 && held.b0 + b + a < 8.0 - 0x1p-27;
    } else {
        return a < 8.0 && is_magnitude_at_most(b, std::numeric_limits<typename Format::Coefficient>::max());
    }
}

/// Walks a cascade from its first section on.
template <class Format>
class CascadeError {
public:
    /// \param peak  of the input \param fastest  the largest d
    CascadeError(double peak, double fastest)
        : swing_(fastest > 1.0 ? fastest / (2.0 - fastest) : 1.0), peak_(peak), reach_(peak) {
        if constexpr (Format::fixed_point) {
            error_ = 0x1p-32;
        } else {
            error_ = Format::data_roundoff * peak + smallest;
        }
    }

    /// \param down  b0 of q31, 2^-(s_i - s_(i-1)); else 1 \param scale_bits  s_i
    void pass(const Section& section, const HeldSection& held, double down, int scale_bits) {
        // What a double errs by in a zero, and in the coefficients made of it.
        constexpr double exact = 0x1p-46;
        const double in = reach_ + error_;
        gain_ *= section.gain;
        reach_ = peak_ * (1.0 + magnitude_of(gain_ - 1.0) * swing_);
        const double norm = 1.0 + magnitude_of(section.gain - 1.0) * swing_;
        const double kept = forgets(section.slow) * forgets(section.fast);
        double of_input = (magnitude_of(held.b1 / down - section.b1) + magnitude_of(held.b2 / down - section.b2)) +
                          exact * (magnitude_of(section.b1) + magnitude_of(section.b2));
        double of_output = magnitude_of(held.a1 - section.a1) + magnitude_of(held.a2 - section.a2) +
                           exact * (magnitude_of(section.a1) + magnitude_of(section.a2));
        double once = 0.0;
        double dropped = 0.0;
        if constexpr (Format::fixed_point) {
            const double unit = power_of_two(scale_bits - 31);
            dropped = unit / forgets(section.fast);
        } else {
            constexpr double u = Format::data_roundoff * (1.0 + 8.0 * Format::data_roundoff);
            of_input += u * (2.0 * magnitude_of(held.b1) + 2.0 + 3.0 * magnitude_of(held.b2));
            of_output += u * (2.0 * magnitude_of(held.a1) + 3.0 + 3.0 * magnitude_of(held.a2));
            once = 4.0 * smallest;
        }
        const double left = kept - of_output;  // above 0, or what is wrong grows
        error_ = left > 0.0 ? (kept * (norm * error_ + dropped) + of_input * in + of_output * reach_ + once) / left
                            : std::numeric_limits<double>::infinity();
    }

    /// What the output reaches at most, exact, and how far it is from that.
    [[nodiscard]] double reach() const { return reach_; }
    [[nodiscard]] double error() const { return error_; }

private:
    static constexpr double smallest = [] {
        if constexpr (Format::fixed_point) {
            return 0.0;
        } else {
            return static_cast<double>(std::numeric_limits<typename Format::Sample>::denorm_min());
        }
    }();
    double swing_;
    double peak_;
    double reach_;
    double error_ = 0.0;
    double gain_ = 1.0;
};

/// The last near tap of a design, which its modes follow: 1 where there is no other.
[[nodiscard]] inline double last_near_tap(const Design& design) {
    Weights weights(design);
    for (std::size_t j = 2 * design.modes.size() + 1; j < design.taps; ++j) {
        weights.next();
    }
    return weights.weight();
}

/// Where a section stands in its cascade.
struct SectionPlace {
    Section exact;
    bool single;     ///< of one pole
    double down;     ///< 2^-(s_i - s_(i-1))
    int scale_bits;  ///< s_i; 0 in floating point
};

/// Calls visit(held, place) for each section, while it says true.
/// \return whether it always did, and in fixed point whether each fits some scale \pre the modes interlace
template <class Format, class Visit>
bool for_each_section(const Design& design, const Visit& visit) {
    if (design.modes.empty()) {
        return true;
    }
    const Series series(design.modes, last_near_tap(design));
    const Sections sections(series);
    CascadeError<Format> walk(1.0, design.modes.back().decay);
    int scale_bits = 0;
    for (std::size_t s = 0; s < sections.size(); ++s) {
        const Section exact = sections[s];
        const bool single = sections.has_single() && s == 0;
        HeldSection held = held_of<Format>(exact, 1.0, single);
        double down = 1.0;
        if constexpr (Format::fixed_point) {
            constexpr int most_bits = 28;
            CascadeError<Format> tried = walk;
            for (;; ++scale_bits, down *= 0.5) {
                if (scale_bits > most_bits) {
                    return false;
                }
                held = held_of<Format>(exact, down, single);
                tried = walk;
                tried.pass(exact, held, down, scale_bits);
                if (tried.reach() + tried.error() <= power_of_two(scale_bits) * (1.0 - 0x1p-30)) {
                    break;
                }
            }
            walk = tried;
        }
        if (!visit(held, SectionPlace{exact, single, down, scale_bits})) {
            return false;
        }
    }
    return true;
}

}  // namespace glsum
