#include "gap/drive/residuals/whiten.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace gap {

std::vector<double> Whitener::apply(std::span<const double> residuals) const {
    std::vector<double> white(residuals.size());
    for (std::size_t k = 0; k < residuals.size(); ++k) {
        if (k < coefficients.size()) {
            white[k] = residuals[k] / stationary_deviation;
            continue;
        }
        double value = residuals[k];
        for (std::size_t i = 0; i < coefficients.size(); ++i) {
            value -= coefficients[i] * residuals[k - 1 - i];
        }
        white[k] = value / deviation;
    }
    return white;
}

std::vector<double> Whitener::log_likelihood(std::span<const double> residuals, std::span<const double> spread) const {
    constexpr double degrees = 5.0;
    // Scaled to unit variance.
    constexpr double scale = (degrees - 2.0) / degrees;
    std::vector<double> logs = apply(residuals);
    for (std::size_t k = 0; k < logs.size(); ++k) {
        const double more = spread.empty() ? 1.0 : spread[k];
        const double unit = more * (k < coefficients.size() ? stationary_deviation : deviation);
        const double size = logs[k] / more;
        logs[k] = -0.5 * (degrees + 1.0) * std::log1p(size * size / (scale * degrees)) - std::log(unit);
    }
    return logs;
}

namespace {

double samples_apart(const std::vector<std::vector<double>>& residuals) {
    const auto covariance = [&](std::size_t lag) {
        double sum = 0.0;
        for (const std::vector<double>& record : residuals) {
            for (std::size_t k = lag; k < record.size(); ++k) {
                sum += record[k] * record[k - lag];
            }
        }
        return sum;
    };
    const double whole = covariance(0);
    double apart = 1.0;
    for (std::size_t lag = 1; lag <= residuals.front().size() / 4; ++lag) {
        const double now = covariance(lag);
        if (!(now > 0.0)) {
            break;
        }
        apart += 2.0 * now / whole;
    }
    return apart;
}

}  // namespace

Whitener fit_whitener(const std::vector<std::vector<double>>& residuals, std::size_t most, double least_deviation) {
    std::vector<double> covariance(most + 1, 0.0);
    double count = 0.0;
    for (const std::vector<double>& record : residuals) {
        for (std::size_t lag = 0; lag <= most; ++lag) {
            for (std::size_t k = lag; k < record.size(); ++k) {
                covariance[lag] += record[k] * record[k - lag];
            }
        }
        count += static_cast<double>(record.size());
    }
    // What rounding or a quantum leaves, at least.
    covariance[0] += 1e-9 * covariance[0] + count * 1e-6 * least_deviation * least_deviation;
    Whitener best;
    best.stationary_deviation = best.deviation = std::max(least_deviation, std::sqrt(covariance[0] / count));
    best.samples_apart = samples_apart(residuals);
    double least = count * std::log(covariance[0]);
    std::vector<double> coefficients;
    double variance = covariance[0];
    for (std::size_t order = 1; order <= most; ++order) {  // Levinson and Durbin
        double reflection = covariance[order];
        for (std::size_t i = 0; i < coefficients.size(); ++i) {
            reflection -= coefficients[i] * covariance[order - 1 - i];
        }
        reflection /= variance;
        std::vector<double> next = coefficients;
        for (std::size_t i = 0; i < coefficients.size(); ++i) {
            next[i] -= reflection * coefficients[coefficients.size() - 1 - i];
        }
        next.push_back(reflection);
        coefficients = next;
        variance *= 1.0 - reflection * reflection;
        const double criterion = count * std::log(variance) + static_cast<double>(order) * std::log(count);
        if (criterion < least) {
            least = criterion;
            best.coefficients = coefficients;
            best.deviation = std::max(least_deviation, std::sqrt(variance / count));
        }
    }
    return best;
}

Interval bootstrap_sum(std::span<const double> values, std::size_t block, std::size_t draws) {
    const std::size_t size = values.size();
    block = std::clamp<std::size_t>(block, 1, std::max<std::size_t>(1, size / 4));
    std::vector<double> running(size + 1, 0.0);
    for (std::size_t i = 0; i < size; ++i) {
        running[i + 1] = running[i] + values[i];
    }
    const std::size_t blocks = (size + block - 1) / block;
    const double scale = static_cast<double>(size) / static_cast<double>(blocks * block);
    std::mt19937_64 random(7);
    std::vector<double> sums(draws);
    for (double& sum : sums) {
        sum = 0.0;
        for (std::size_t b = 0; b < blocks; ++b) {
            const std::size_t from = random() % (size - block + 1);
            sum += running[from + block] - running[from];
        }
        sum *= scale;
    }
    std::sort(sums.begin(), sums.end());
    return {running[size], sums[draws / 20], sums[draws - 1 - draws / 20]};
}

}  // namespace gap
