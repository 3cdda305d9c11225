// Starts of a fit: a search over a grid in a closed loop, and Kuepfmueller's tangent.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/failure.hpp"
#include "drive/controller.hpp"
#include "drive/fit.hpp"
#include "drive/open_start.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

// A closed loop on an even grid of some hundred points, by the closed form of the step response: rough and fast.
class RoughLoop {
public:
    static constexpr std::size_t points = 300;

    explicit RoughLoop(const Record& record) : step_s_(record.time_s.back() / (points - 1)) {
        std::size_t at = 0;
        std::vector<double> time_s;
        for (std::size_t k = 0; k < points; ++k) {
            time_s.push_back(static_cast<double>(k) * step_s_);
            while (at + 1 < record.time_s.size() && record.time_s[at + 1] <= time_s.back() + 1e-9 * step_s_) {
                ++at;
            }
            reference_.push_back(record.reference[at]);
            output_.push_back(record.output[at]);
        }
        controller_ = respond(*record.controller, std::vector<Change>{{0.0, 1.0}}, time_s);
        controller_[0] = direct_gain(*record.controller);
    }
    /// What a unit error has put out after a tenth of the record.
    [[nodiscard]] double controller_gain() const { return controller_[points / 10]; }

    /// \param step  the plant's response after each number of steps \return infinite where the loop runs away
    [[nodiscard]] double sum_of_squares(const std::vector<double>& step) const {
        std::vector<double> error_change(points);
        std::vector<double> input_change(points);
        double error = 0.0;
        double input = 0.0;
        double sum = 0.0;
        for (std::size_t k = 0; k < points; ++k) {
            double output = 0.0;
            for (std::size_t j = 0; j < k; ++j) {
                output += input_change[j] * step[k - j];
            }
            sum += (output - output_[k]) * (output - output_[k]);
            if (!(std::fabs(output) < 1e12)) {
                return std::numeric_limits<double>::infinity();
            }
            error_change[k] = reference_[k] - output - error;
            error += error_change[k];
            double now = 0.0;
            for (std::size_t j = 0; j <= k; ++j) {
                now += error_change[j] * controller_[k - j];
            }
            input_change[k] = now - input;
            input = now;
        }
        return sum;
    }
    [[nodiscard]] double step_s() const { return step_s_; }

private:
    double step_s_;
    std::vector<double> reference_;
    std::vector<double> output_;
    std::vector<double> controller_;
};

Model search_loop_start(Kind kind, const Record& record) {
    const RoughLoop loop(record);
    const double controller = loop.controller_gain();
    if (controller == 0.0) {
        refuse("no start found: the controller does not answer; expected --start MODEL.json");
    }
    Model best;
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> step(RoughLoop::points);
    for (int i = 0; i < 12; ++i) {
        const double time_constant_s = record.time_s.back() * std::pow(0.003, i / 11.0);
        for (int j = 0; j < 12; ++j) {
            const double delay_s = 0.3 * record.time_s.back() * (j / 12.0) * (j / 12.0);
            for (int g = 0; g < 16; ++g) {
                const double gain = 0.02 / controller * std::pow(2000.0, g / 15.0);
                for (std::size_t k = 0; k < step.size(); ++k) {
                    const double x = (static_cast<double>(k) * loop.step_s() - delay_s) / time_constant_s;
                    step[k] = x <= 0.0 ? 0.0 : gain * (1.0 - (kind == Kind::fopdt ? 1.0 : 1.0 + x) * std::exp(-x));
                }
                const double error = loop.sum_of_squares(step);
                if (error < least) {
                    least = error;
                    best = kind == Kind::fopdt ? make_fopdt(gain, time_constant_s, delay_s)
                                               : make_sopdt(gain, time_constant_s, delay_s);
                }
            }
        }
    }
    if (!std::isfinite(least)) {
        refuse("no start found: every loop of the search runs away; expected --start MODEL.json");
    }
    return best;
}

}  // namespace

Model search_start(Kind kind, const std::vector<Record>& records) {
    for (const Record& record : records) {
        if (record.controller) {
            return search_loop_start(kind, record);
        }
    }
    return search_open_start(kind, records);
}

Model tangent_construction(Kind kind, const Record& record) {
    if (record.controller) {
        refuse(fmt::format("{}: expected an open loop for the tangent construction, found a controller", record.name));
    }
    const double from_s = record.changes.front().time_s;
    const double size = record.changes.front().size;
    const double to_s = record.changes.size() > 1 ? record.changes[1].time_s : record.time_s.back();
    std::vector<double> t;
    std::vector<double> y;
    double old_level = 0.0;
    std::size_t before = 0;
    for (std::size_t i = 0; i < record.time_s.size(); ++i) {
        if (record.time_s[i] <= from_s) {
            old_level += record.output[i];
            ++before;
        }
        if (record.time_s[i] >= from_s && record.time_s[i] <= to_s) {
            t.push_back(record.time_s[i] - from_s);
            y.push_back(record.output[i]);
        }
    }
    if (t.size() < 20) {
        refuse(
            fmt::format("{}: expected at least 20 samples after a step that is held, found {}", record.name, t.size()));
    }
    old_level = before > 0 ? old_level / static_cast<double>(before) : 0.0;
    const std::size_t tail = std::max<std::size_t>(5, t.size() / 10);
    const auto mean = [&](std::size_t first, std::size_t count) {
        return std::accumulate(y.begin() + static_cast<std::ptrdiff_t>(first),
                               y.begin() + static_cast<std::ptrdiff_t>(first + count), 0.0) /
               static_cast<double>(count);
    };
    const double new_level = mean(t.size() - tail, tail);
    const double rise = new_level - old_level;
    const double earlier = mean(t.size() - 2 * tail, tail);
    if (rise == 0.0 || std::fabs(new_level - earlier) > 0.1 * std::fabs(rise)) {
        refuse(fmt::format(
            "{}: expected a step response that settles; between the last two tenths before {} s the output still "
            "moves by {:.2g} of {:.2g}",
            record.name, to_s, new_level - earlier, rise));
    }
    // The steepest straight line through a window: a twelfth of the time from a tenth to nine tenths of the rise, and
    // at least 5 samples, of which noise and quantisation average out.
    const auto reached = [&](double part) {
        for (std::size_t i = 0; i < t.size(); ++i) {
            if ((y[i] - old_level) / rise >= part) {
                return i;
            }
        }
        return t.size() - 1;
    };
    const std::size_t half = std::max<std::size_t>(2, (reached(0.9) - reached(0.1)) / 24);
    double slope = 0.0;
    double meets_s = 0.0;
    for (std::size_t i = half; i + half < t.size(); ++i) {
        const auto count = static_cast<double>(2 * half + 1);
        double mean_t = 0.0;
        double mean_y = 0.0;
        for (std::size_t k = i - half; k <= i + half; ++k) {
            mean_t += t[k] / count;
            mean_y += y[k] / count;
        }
        double product = 0.0;
        double square = 0.0;
        for (std::size_t k = i - half; k <= i + half; ++k) {
            product += (t[k] - mean_t) * (y[k] - mean_y);
            square += (t[k] - mean_t) * (t[k] - mean_t);
        }
        if (product / square / rise > slope) {
            slope = product / square / rise;
            meets_s = mean_t - (mean_y - old_level) / rise / slope;
        }
    }
    const double rise_s = 1.0 / slope;
    const double gain = rise / size;
    if (kind == Kind::fopdt) {
        return make_fopdt(gain, rise_s, std::max(0.0, meets_s));
    }
    const double time_constant_s = rise_s / std::exp(1.0);
    return make_sopdt(gain, time_constant_s, std::max(0.0, meets_s - (3.0 - std::exp(1.0)) * time_constant_s));
}

}  // namespace drive
