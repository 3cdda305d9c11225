#include "drive/inverse_laplace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "qemu/failure.hpp"

namespace drive {
namespace {

using Complex = std::complex<double>;

constexpr double line = 25.0;       // the line lies at line / (2t): aliasing e^-25, rounding magnified by e^12.5
constexpr int averaged_terms = 18;  // by binomial weights, behind the plain ones
constexpr int fewest_terms = 12;
constexpr int most_terms = 1024;
constexpr double accepted = 2e-10;  // relative to the function's size: between two runs, and of the last coefficients
constexpr std::size_t most_pieces = 128;

struct Value {
    double value;
    double size;  // what the function would be if it were about constant
};

Value euler_sum(const InverseLaplace::Image& image, double abscissa, double t, int terms) {
    const double real = abscissa + line / (2.0 * t);
    const double first = 0.5 * image({real, 0.0}).real();
    double sum = first;
    double sign = -1.0;
    double binomial = 1.0;
    double average = 0.0;
    for (int k = 1; k <= terms + averaged_terms; ++k) {
        sum += sign * image({real, std::numbers::pi * k / t}).real();
        sign = -sign;
        if (const int j = k - terms; j >= 0) {
            average += binomial * sum;
            binomial *= static_cast<double>(averaged_terms - j) / (j + 1);
        }
    }
    const double scale = std::exp(real * t) / t;
    return {scale * average * std::exp2(-averaged_terms), std::exp(abscissa * t) * std::fabs(first) / t * line};
}

[[noreturn]] void refuse(double t) {
    throw glsum::Failure(glsum::Exit::check_failed,
                         fmt::format("the response around {} s does not converge: too lightly damped, or unstable, "
                                     "for so long a record",
                                     t));
}

constexpr double checks[] = {1.0, 1.21, 1.47, 1.73, 2.0};

}  // namespace

InverseLaplace::InverseLaplace(Image image, std::vector<Swing> swings)
    : image_(std::move(image)), swings_(std::move(swings)) {}

double InverseLaplace::operator()(double t) {
    if (!(t > 0.0)) {
        return 0.0;
    }
    const int exponent = std::ilogb(t);
    if (last_ == nullptr || exponent != last_exponent_) {
        last_ = &octave(exponent);
        last_exponent_ = exponent;
    }
    const auto count = static_cast<double>(last_->pieces.size());
    const double place = (std::scalbn(t, -exponent) - 1.0) * count;
    const auto index = std::min(static_cast<std::size_t>(place), last_->pieces.size() - 1);
    const std::array<double, nodes>& c = last_->pieces[index];
    const double x = 2.0 * (place - static_cast<double>(index)) - 1.0;
    double one = 0.0;  // Clenshaw's recurrence
    double two = 0.0;
    for (std::size_t k = nodes - 1; k > 0; --k) {
        two = std::exchange(one, c[k] + 2.0 * x * one - two);
    }
    return c[0] + x * one - two;
}

const InverseLaplace::Octave& InverseLaplace::octave(int exponent) {
    const auto found = octaves_.find(exponent);
    return found != octaves_.end() ? found->second : octaves_.emplace(exponent, make_octave(exponent)).first->second;
}

InverseLaplace::Octave InverseLaplace::make_octave(int exponent) const {
    const double from = std::scalbn(1.0, exponent);
    double abscissa = 0.0;
    for (const Swing& swing : swings_) {
        abscissa = std::max(abscissa, -swing.decay_per_s);
    }
    if (abscissa * 2.0 * from > std::log(1e3)) {
        refuse(from);
    }
    // A swing beyond the terms' frequencies would go unseen, by both runs alike.
    const double fastest = fastest_left(swings_, from, accepted);
    int terms = std::max(fewest_terms, static_cast<int>(std::min(1e6, 1.5 * fastest * 2.0 * from / std::numbers::pi)));
    double size = 0.0;
    for (;; terms = 3 * terms / 2) {
        if (terms > most_terms) {
            refuse(from);
        }
        double difference = 0.0;
        for (const double check : checks) {
            const Value rough = euler_sum(image_, abscissa, check * from, terms);
            const Value fine = euler_sum(image_, abscissa, check * from, 3 * terms / 2);
            size = std::max({size, std::fabs(fine.value), fine.size});
            difference = std::max(difference, std::fabs(fine.value - rough.value));
            if (!std::isfinite(fine.value)) {
                refuse(check * from);
            }
        }
        if (difference <= accepted * size) {
            break;
        }
    }
    Octave octave;
    for (std::size_t pieces = 1; pieces <= most_pieces; pieces *= 2) {
        octave.pieces.resize(pieces);
        double difference = 0.0;
        for (std::size_t p = 0; p < pieces; ++p) {
            std::array<double, nodes> values;
            for (std::size_t i = 0; i < nodes; ++i) {
                const double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / nodes);
                const double place = (static_cast<double>(p) + 0.5 * (x + 1.0)) / static_cast<double>(pieces);
                values[i] = euler_sum(image_, abscissa, from * (1.0 + place), terms).value;
            }
            std::array<double, nodes>& c = octave.pieces[p];
            for (std::size_t k = 0; k < nodes; ++k) {
                double sum = 0.0;
                for (std::size_t i = 0; i < nodes; ++i) {
                    sum += values[i] *
                           std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(i) + 0.5) / nodes);
                }
                c[k] = sum * (k == 0 ? 1.0 : 2.0) / nodes;
            }
            // The last coefficients bound what the polynomial leaves out.
            difference = std::max({difference, std::fabs(c[nodes - 1]), std::fabs(c[nodes - 2])});
        }
        if (difference <= accepted * size) {
            return octave;
        }
    }
    refuse(from);
}

}  // namespace drive
