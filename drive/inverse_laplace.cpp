#include "drive/inverse_laplace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/failure.hpp"

namespace drive {
namespace {

constexpr double line = 25.0;       // the line lies at line / (2t): aliasing e^-25, rounding magnified by e^12.5
constexpr int averaged_terms = 18;  // by binomial weights, behind the plain ones
constexpr int fewest_terms = 12;
constexpr int most_terms = 1024;
constexpr double accepted = 2e-10;  // relative to the function's size: between two runs, and of the last coefficients
constexpr std::size_t most_pieces = 128;
// Of an image, relative: near a pole its divisor is a small difference of terms.
constexpr double image_rounding = 16.0 * std::numeric_limits<double>::epsilon();

[[noreturn]] void refuse(double t) {
    throw glsum::Failure(glsum::Exit::check_failed,
                         fmt::format("the response around {} s does not converge: too lightly damped, or unstable, "
                                     "for so long a record",
                                     t));
}

// A pole is known to some roundings: so is the angle that it has turned by.
constexpr double most_radians = accepted / image_rounding;

constexpr double checks[] = {1.0, 1.41, 2.0};

// Chebyshev's polynomials, T_k at node i.
const std::array<std::array<double, InverseLaplace::nodes>, InverseLaplace::nodes>& chebyshev_at_nodes() {
    static const auto table = [] {
        std::array<std::array<double, InverseLaplace::nodes>, InverseLaplace::nodes> cosines{};
        for (std::size_t k = 0; k < InverseLaplace::nodes; ++k) {
            for (std::size_t i = 0; i < InverseLaplace::nodes; ++i) {
                cosines[k][i] = std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(i) + 0.5) /
                                         InverseLaplace::nodes);
            }
        }
        return cosines;
    }();
    return table;
}

}  // namespace

InverseLaplace::InverseLaplace(std::size_t count, Image image, std::vector<Swing> swings)
    : count_(count), image_(std::move(image)), swings_(std::move(swings)) {
    for (const Swing& swing : swings_) {
        parts_.push_back(swing_part(image_, count_, swing, swings_));
    }
}

void InverseLaplace::at(double t, std::span<double> values) {
    if (!(t > 0.0)) {
        std::fill(values.begin(), values.end(), 0.0);
        return;
    }
    const int exponent = std::ilogb(t);
    if (last_ == nullptr || exponent != last_exponent_) {
        last_ = &octave(exponent);
        last_exponent_ = exponent;
    }
    const double place = (std::scalbn(t, -exponent) - 1.0) * static_cast<double>(last_->pieces);
    const auto index = static_cast<std::size_t>(place);  // below the number of pieces, a power of two: exactly
    const double x = 2.0 * (place - static_cast<double>(index)) - 1.0;
    for (std::size_t f = 0; f < values.size(); ++f) {
        const std::array<double, nodes>& c = last_->coefficients[index * count_ + f];
        double one = 0.0;  // Clenshaw's recurrence
        double two = 0.0;
        for (std::size_t k = nodes - 1; k > 0; --k) {
            two = std::exchange(one, c[k] + 2.0 * x * one - two);
        }
        values[f] = c[0] + x * one - two;
    }
    for (const SwingPart* part : last_->parts) {
        part->add_to(values, t);
    }
}

const InverseLaplace::Octave& InverseLaplace::octave(int exponent) {
    const auto found = octaves_.find(exponent);
    return found != octaves_.end() ? found->second : octaves_.emplace(exponent, make_octave(exponent)).first->second;
}

// `sizes`: what each function would be if it were about constant, or of what rounding leaves, if that is more: where
// the image of a swing is large that has long decayed, no more terms and no shorter pieces tell more digits.
void InverseLaplace::euler_sum(const Octave& octave, double abscissa, double t, int terms, std::span<double> values,
                               std::span<double> sizes) const {
    const double real = abscissa + line / (2.0 * t);
    std::vector<Complex> at(count_);
    std::vector<double> sum(count_);
    image_({real, 0.0}, at);
    for (std::size_t f = 0; f < count_; ++f) {
        sizes[f] = std::exp(abscissa * t) * std::fabs(0.5 * at[f].real()) / t * line;
        values[f] = 0.0;
        for (const SwingPart* part : octave.parts) {
            sizes[f] = std::max(sizes[f], part->size(f, t));
        }
    }
    for (const SwingPart* part : octave.parts) {
        part->take_from(at, {real, 0.0});
    }
    for (std::size_t f = 0; f < count_; ++f) {
        sum[f] = 0.5 * at[f].real();
    }
    double sign = -1.0;
    const double magnified = std::exp(real * t) / t;
    const double rounded = image_rounding * magnified / accepted;
    double binomial = magnified * std::exp2(-averaged_terms);
    for (int k = 1; k <= terms + averaged_terms; ++k) {
        const Complex s(real, std::numbers::pi * k / t);
        image_(s, at);
        for (std::size_t f = 0; f < count_; ++f) {
            sizes[f] = std::max(sizes[f], rounded * (std::fabs(at[f].real()) + std::fabs(at[f].imag())));
        }
        for (const SwingPart* part : octave.parts) {
            part->take_from(at, s);
        }
        for (std::size_t f = 0; f < count_; ++f) {
            sum[f] += sign * at[f].real();
        }
        sign = -sign;
        if (const int j = k - terms; j >= 0) {
            for (std::size_t f = 0; f < count_; ++f) {
                values[f] += binomial * sum[f];
            }
            binomial *= static_cast<double>(averaged_terms - j) / (j + 1);
        }
    }
}

InverseLaplace::Octave InverseLaplace::make_octave(int exponent) const {
    const double from = std::scalbn(1.0, exponent);
    Octave octave;
    double abscissa = 0.0;
    std::vector<Swing> left;
    for (std::size_t i = 0; i < swings_.size(); ++i) {
        const Swing& swing = swings_[i];
        if (-swing.decay_per_s * 2.0 * from > std::log(1e3)) {
            refuse(from);
        }
        // Before a swing has swung, its part is large beside the function, which is still small.
        if (parts_[i] && swing.radians_per_s * from > 1.0) {
            octave.parts.push_back(&*parts_[i]);
            if (swing.radians_per_s * 2.0 * from > most_radians && fastest_left({swing}, from, accepted) > 0.0) {
                refuse(from);
            }
        } else {
            left.push_back(swing);
            abscissa = std::max(abscissa, -swing.decay_per_s);
        }
    }
    // A swing beyond the terms' frequencies would go unseen, by both runs alike.
    const double fastest = fastest_left(left, from, accepted);
    int terms = std::max(fewest_terms, static_cast<int>(std::min(1e6, 1.5 * fastest * 2.0 * from / std::numbers::pi)));
    std::vector<double> rough(count_);
    std::vector<double> fine(count_);
    std::vector<double> now(count_);
    std::vector<double> size(count_, 0.0);
    for (bool good = false; !good; terms = good ? terms : 3 * terms / 2) {
        if (terms > most_terms) {
            refuse(from);
        }
        std::vector<double> difference(count_, 0.0);
        for (const double check : checks) {
            euler_sum(octave, abscissa, check * from, terms, rough, now);
            euler_sum(octave, abscissa, check * from, 3 * terms / 2, fine, now);
            for (std::size_t f = 0; f < count_; ++f) {
                size[f] = std::max({size[f], std::fabs(fine[f]), now[f]});
                difference[f] = std::max(difference[f], std::fabs(fine[f] - rough[f]));
                if (!std::isfinite(fine[f])) {
                    refuse(check * from);
                }
            }
        }
        good = true;
        for (std::size_t f = 0; f < count_; ++f) {
            good = good && difference[f] <= accepted * size[f];
        }
    }
    std::vector<std::array<double, nodes>> values(count_);
    for (; octave.pieces <= most_pieces; octave.pieces *= 2) {
        octave.coefficients.assign(octave.pieces * count_, {});
        bool good = true;
        for (std::size_t p = 0; p < octave.pieces; ++p) {
            for (std::size_t i = 0; i < nodes; ++i) {
                const double x = chebyshev_at_nodes()[1][i];
                const double place = (static_cast<double>(p) + 0.5 * (x + 1.0)) / static_cast<double>(octave.pieces);
                euler_sum(octave, abscissa, from * (1.0 + place), terms, fine, now);
                for (std::size_t f = 0; f < count_; ++f) {
                    values[f][i] = fine[f];
                }
            }
            for (std::size_t f = 0; f < count_; ++f) {
                std::array<double, nodes>& c = octave.coefficients[p * count_ + f];
                std::transform(
                    chebyshev_at_nodes().begin(), chebyshev_at_nodes().end(), c.begin(), [&](const auto& polynomial) {
                        return std::inner_product(values[f].begin(), values[f].end(), polynomial.begin(), 0.0) * 2.0 /
                               nodes;
                    });
                c[0] /= 2.0;
                // The last coefficients bound what the polynomial leaves out.
                good = good && std::max(std::fabs(c[nodes - 1]), std::fabs(c[nodes - 2])) <= accepted * size[f];
            }
        }
        if (good) {
            return octave;
        }
    }
    refuse(from);
}

}  // namespace drive
