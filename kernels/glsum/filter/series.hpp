// Decaying modes behind a tap as a product in place of a sum: the same filter, by its zeros.
//
//   lead + sum_m w_m q/(1 - (1-d_m) q) = lead prod_m (1 - (1-e_m) q)/(1 - (1-d_m) q),     q = z^-1.
//
// The e_m, 1 less the zeros, are the roots of lead + sum_m w_m/(d_m - e). Where all weights have one sign, that
// function rises, or falls, between any two neighbours of the d_m from one infinity to the other: one real zero between
// them, and the last beyond the slowest or the fastest, at most the sum of all |w_m/lead| away. The weights of an order
// are such mixtures, and so are Oustaloup's and Charef's filters. Halving finds each zero to the last bits of a double,
// with operations that every machine rounds alike.
#pragma once

#include <cstddef>
#include <span>

#include "glsum/design_range.hpp"
#include "glsum/kernel.hpp"

namespace glsum {

class Series {
public:
    /// \param modes  slowest first \param lead  the tap before them
    Series(std::span<const Mode> modes, double lead) : modes_(modes), lead_(lead) {
        for (const Mode& mode : modes) {
            const double ratio = mode.weight / lead;
            reach_ += ratio < 0.0 ? -ratio : ratio;
        }
    }

    /// Whether zeros and poles interlace: decays that rise, weights of one sign, none of them 0.
    [[nodiscard]] bool interlaces() const {
        bool all = is_magnitude_at_most(reach_, std::numeric_limits<double>::max());
        for (std::size_t m = 0; m < modes_.size(); ++m) {
            const bool same = rising() ? modes_[m].weight / lead_ > 0.0 : modes_[m].weight / lead_ < 0.0;
            all = all && same && (m == 0 || modes_[m].decay > modes_[m - 1].decay);
        }
        return all;
    }

    /// e_m, the zero that lies next to the pole of mode m. \pre interlaces()
    [[nodiscard]] double zero(std::size_t m) const {
        double low = modes_[m].decay;
        double high = low;
        if (rising()) {
            high = m + 1 < modes_.size() ? modes_[m + 1].decay : low + reach_;
        } else {
            low = m > 0 ? modes_[m - 1].decay : high - reach_;
        }
        constexpr int halvings = 128;  // more only of a zero at 0 itself, where nothing is left to tell
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (low + high);
            if (!(middle > low && middle < high)) {
                break;
            }
            const double there = at(middle);
            (rising() == (there < 0.0) ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }
    [[nodiscard]] double pole(std::size_t m) const { return modes_[m].decay; }
    [[nodiscard]] std::size_t size() const { return modes_.size(); }

private:
    [[nodiscard]] bool rising() const { return modes_.front().weight / lead_ > 0.0; }
    [[nodiscard]] double at(double decay) const {
        double sum = 1.0;
        for (const Mode& mode : modes_) {
            sum += mode.weight / lead_ / (mode.decay - decay);
        }
        return sum;
    }

    std::span<const Mode> modes_;
    double lead_;
    double reach_ = 0.0;  // sum |w_m/lead|
};

/// A second-order section (1 + b1 q + b2 q^2)/(1 + a1 q + a2 q^2); of one pole alone b2 = a2 = 0.
struct Section {
    double b1;
    double b2;
    double a1;
    double a2;
    double gain;  ///< at rest: of a constant
    double slow;  ///< d of its slower pole
    double fast;  ///< of its faster one; 1 of one pole alone, which is no pole
};

/// The sections of a cascade, M/2 of two poles and before them, of an odd M, one of the pole in the middle. The slowest
/// pole goes with the fastest, the next with the next: poles that lie apart move least when coefficients are rounded.
class Sections {
public:
    explicit Sections(const Series& series) : series_(series) {}
    [[nodiscard]] std::size_t size() const { return (series_.size() + 1) / 2; }
    [[nodiscard]] bool has_single() const { return series_.size() % 2 != 0; }

    [[nodiscard]] Section operator[](std::size_t s) const {
        const std::size_t modes = series_.size();
        const std::size_t slow = size() - 1 - s;
        const std::size_t fast = modes - 1 - slow;
        const double zero = series_.zero(slow);
        const double pole = series_.pole(slow);
        if (slow == fast) {
            return {zero - 1.0, 0.0, pole - 1.0, 0.0, zero / pole, pole, 1.0};
        }
        const double other_zero = series_.zero(fast);
        const double other_pole = series_.pole(fast);
        return {zero + other_zero - 2.0,
                (1.0 - zero) * (1.0 - other_zero),
                pole + other_pole - 2.0,
                (1.0 - pole) * (1.0 - other_pole),
                (zero / pole) * (other_zero / other_pole),
                pole,
                other_pole};
    }

private:
    const Series& series_;
};

}  // namespace glsum
