#include "drive/open_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/failure.hpp"
#include "drive/real_transform.hpp"

namespace drive {
namespace {

// The response to a unit step of unit gain, x time constants after it; damping: of a second order.
double unit_step(bool second_order, double damping, double x) {
    if (!second_order) {
        return 1.0 - std::exp(-x);
    }
    if (damping == 1.0) {
        return 1.0 - (1.0 + x) * std::exp(-x);
    }
    const double swing = std::sqrt(1.0 - damping * damping);
    return 1.0 - std::exp(-damping * x) * (std::cos(swing * x) + damping / swing * std::sin(swing * x));
}

// A record on an even grid, where a dead time is a shift and a log whose input changes at each stamp costs no more
// than a step: both sums over all of it are convolutions.
class RoughRecord {
public:
    RoughRecord(const Record& record, double step_s)
        : output_(on_grid(record, step_s)),
          length_(RealTransform::fast_length(2 * output_.size())),
          input_change_(length_),
          output_from_the_end_(length_, std::vector<double>(output_.rbegin(), output_.rend())) {
        for (const Change& change : record.changes) {
            const auto nearest = static_cast<std::size_t>(std::lround(std::max(0.0, change.time_s) / step_s));
            if (nearest < output_.size()) {
                input_change_.reals()[nearest] += change.size;
            }
        }
        RealTransform::of(length_).forward(input_change_);
        RealTransform::of(length_).forward(output_from_the_end_);
        for (const double y : output_) {
            output_square_ += y * y;
        }
    }
    [[nodiscard]] std::size_t points() const { return output_.size(); }
    [[nodiscard]] double output_square() const { return output_square_; }

    // Adds the response's product with the output, and its own square, for each dead time of so many steps.
    void add(std::span<const double> step, std::span<double> products, std::span<double> squares) const {
        const RealTransform& transform = RealTransform::of(length_);
        RealTransform::Buffer response(length_, step.first(points()));
        transform.forward(response);
        transform.convolve(response, input_change_);
        const std::span<double> values = response.reals();
        std::fill(values.begin() + static_cast<std::ptrdiff_t>(points()), values.end(), 0.0);
        double square = 0.0;
        for (std::size_t k = 0; k < points(); ++k) {
            square += values[k] * values[k];
            if (const std::size_t shift = points() - 1 - k; shift < squares.size()) {
                squares[shift] += square;
            }
        }
        transform.forward(response);
        transform.convolve(response, output_from_the_end_);
        for (std::size_t shift = 0; shift < std::min(points(), products.size()); ++shift) {
            products[shift] += values[points() - 1 - shift];
        }
    }

private:
    static std::vector<double> on_grid(const Record& record, double step_s) {
        std::vector<double> output;
        std::size_t at = 0;
        for (double time_s = 0.0; time_s <= record.time_s.back(); time_s += step_s) {
            while (at + 1 < record.time_s.size() && record.time_s[at + 1] <= time_s + 1e-9 * step_s) {
                ++at;
            }
            output.push_back(record.output[at]);
        }
        return output;
    }

    std::vector<double> output_;
    std::size_t length_;
    RealTransform::Buffer input_change_;
    RealTransform::Buffer output_from_the_end_;
    double output_square_ = 0.0;
};

}  // namespace

Model search_open_start(Kind kind, const std::vector<Record>& records) {
    double longest_s = 0.0;
    std::size_t samples = 0;
    for (const Record& record : records) {
        longest_s = std::max(longest_s, record.time_s.back());
        samples = std::max(samples, record.time_s.size());
    }
    const std::size_t steps = std::clamp<std::size_t>(samples - 1, 400, 4000);
    const double step_s = longest_s / static_cast<double>(steps);
    std::vector<RoughRecord> rough;
    std::size_t most = 0;
    double output_square = 0.0;
    for (const Record& record : records) {
        rough.emplace_back(record, step_s);
        most = std::max(most, rough.back().points());
        output_square += rough.back().output_square();
    }
    const std::vector<double> dampings =
        kind == Kind::niopdt ? std::vector{1.0, 0.5, 0.25, 0.1, 0.05, 0.025} : std::vector{1.0};
    double least = std::numeric_limits<double>::infinity();
    double gain = 0.0;
    double time_constant_s = 0.0;
    double damping = 0.0;
    double delay_s = 0.0;
    std::vector<double> step(most);
    for (const double damped : dampings) {
        // What swings has to be met within a part of a turn after all the time for which it rings.
        const double ratio = std::exp(-std::min(damped, 0.1));
        for (double now_s = longest_s; now_s > 1.2 * step_s; now_s *= ratio) {
            for (std::size_t k = 0; k < step.size(); ++k) {
                step[k] = unit_step(kind != Kind::fopdt, damped, static_cast<double>(k) * step_s / now_s);
            }
            std::vector<double> products(steps / 2, 0.0);
            std::vector<double> squares(steps / 2, 0.0);
            for (const RoughRecord& record : rough) {
                record.add(step, products, squares);
            }
            for (std::size_t shift = 0; shift < products.size(); ++shift) {
                // Of a response that a dead time moves out of the record, rounding is left.
                if (products[shift] == 0.0 || !(squares[shift] > 1e-12 * squares[0])) {
                    continue;
                }
                const double error = output_square - products[shift] * products[shift] / squares[shift];
                if (error < least) {
                    least = error;
                    gain = products[shift] / squares[shift];
                    time_constant_s = now_s;
                    damping = damped;
                    delay_s = static_cast<double>(shift) * step_s;
                }
            }
        }
    }
    if (!std::isfinite(least)) {
        throw glsum::Failure(glsum::Exit::bad_input, "no start found: the output does not follow the input at all");
    }
    if (kind == Kind::fopdt) {
        return make_fopdt(gain, time_constant_s, delay_s);
    }
    Model best = make_sopdt(gain, time_constant_s, delay_s);
    if (kind == Kind::niopdt) {
        best.kind = Kind::fotf;
        best.denominator[1].coefficient *= damping;
    }
    return best;
}

}  // namespace drive
